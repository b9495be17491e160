#include "unilateral/base/sha256.h"

#include <openssl/evp.h>

#include <array>
#include <stdexcept>

namespace unilateral
{
  std::string sha256(const std::string &bytes)
  {
    std::array<unsigned char, 32> digest;
    std::size_t                   size = 0;
    if (!EVP_Q_digest(nullptr, "SHA256", nullptr, bytes.data(), bytes.size(), digest.data(), &size) || size != digest.size())
      throw std::runtime_error("OpenSSL has no SHA-256");
    std::string text;
    for (const unsigned char byte : digest)
    {
      text += "0123456789abcdef"[byte >> 4];
      text += "0123456789abcdef"[byte & 15];
    }
    return text;
  }
} // namespace unilateral
