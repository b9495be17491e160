# `cpack` makes a package for Debian of what is installed: program, library and headers, Python module, manual pages, completion, examples.
# For any processor it has to be compiled with -DUNILATERAL_NATIVE=OFF: `./setup --package` does all of it.
install(DIRECTORY examples doc DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/unilateral PATTERN site EXCLUDE)
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/unilateral)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/unilateral RENAME copyright)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME unilateral)
set(CPACK_PACKAGE_CONTACT "The Unilateral authors <unilateral@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "variational inequalities by finite elements, with certified error")
set(CPACK_PACKAGE_DESCRIPTION "Obstacle problems of membranes, beams and plates, and elastic bodies in
frictionless contact with rigid obstacles: penalty and mixed methods, contact
pressure, inf-sup constants and a bound of the error that the penalty adds.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION math)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# What is not found by looking at the libraries that the programs are linked with: a fast BLAS, which apt would not choose (dense factorisations
# take three times as long without), pictures as PNG, the Python module, the start on several processors; and what programs of others are
# compiled with.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libopenblas0-serial | libopenblas0, librsvg2-bin, python3, python3-numpy")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "openmpi-bin")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "python3-matplotlib, g++, cmake, libdeal.ii-dev, libtomlplusplus-dev, libfmt-dev, libeigen3-dev, nlohmann-json3-dev, libgdal-dev, libgmsh-dev, libsuitesparse-dev, libmumps-dev, libcgal-dev, libssl-dev, libpng-dev")
include(CPack)
