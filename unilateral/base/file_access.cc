#include "unilateral/base/file_access.h"

#include <utility>

namespace unilateral
{
  namespace
  {
    FileAccess &present()
    {
      static FileAccess access;
      return access;
    }
  } // namespace

  const FileAccess &file_access()
  {
    return present();
  }

  void set_file_access(FileAccess access)
  {
    present() = std::move(access);
  }
} // namespace unilateral
