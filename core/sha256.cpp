#include "core/sha256.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <vector>

#include "core/durable_file.h"

namespace drape {
namespace {

using Word = std::uint32_t;

/// The first 32 bits of the fractional part of a root of the i-th prime: exact, for a long double
/// has 64.
template <int kDegree, size_t kCount>
std::array<Word, kCount> prime_roots() {
  std::array<Word, kCount> words{};
  size_t found = 0;
  for (int n = 2; found < kCount; ++n) {
    bool prime = true;
    for (int d = 2; d * d <= n; ++d) prime &= n % d != 0;
    if (!prime) continue;
    const long double root = kDegree == 2 ? std::sqrt(static_cast<long double>(n))
                                          : std::cbrt(static_cast<long double>(n));
    words[found++] = static_cast<Word>((root - std::floor(root)) * 4294967296.0L);
  }
  return words;
}

class Sha256 {
 public:
  void add(const unsigned char* bytes, size_t count) {
    length_ += count;
    while (count > 0) {
      const size_t taken = std::min(count, buffer_.size() - filled_);
      std::memcpy(buffer_.data() + filled_, bytes, taken);
      filled_ += taken;
      bytes += taken;
      count -= taken;
      if (filled_ == buffer_.size()) process();
    }
  }

  std::string finish() {
    const std::uint64_t bits = 8 * length_;
    const unsigned char one = 0x80, zero = 0;
    add(&one, 1);
    while (filled_ != 56) add(&zero, 1);
    std::array<unsigned char, 8> size{};
    for (size_t i = 0; i < 8; ++i) size[i] = static_cast<unsigned char>(bits >> (56 - 8 * i));
    add(size.data(), size.size());
    std::string text;
    for (const Word word : state_)
      for (int shift = 28; shift >= 0; shift -= 4) text += "0123456789abcdef"[(word >> shift) & 15];
    return text;
  }

 private:
  void process() {
    static const std::array<Word, 64> kRound = prime_roots<3, 64>();
    filled_ = 0;
    std::array<Word, 64> w{};
    for (size_t i = 0; i < 16; ++i)
      for (size_t j = 0; j < 4; ++j) w[i] = w[i] << 8 | buffer_[4 * i + j];
    for (size_t i = 16; i < 64; ++i) {
      const Word a = w[i - 15], b = w[i - 2];
      w[i] = w[i - 16] + w[i - 7] + (std::rotr(a, 7) ^ std::rotr(a, 18) ^ (a >> 3)) +
             (std::rotr(b, 17) ^ std::rotr(b, 19) ^ (b >> 10));
    }
    auto [a, b, c, d, e, f, g, h] = state_;
    for (size_t i = 0; i < 64; ++i) {
      const Word t1 = h + (std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25)) +
                      ((e & f) ^ (~e & g)) + kRound[i] + w[i];
      const Word t2 =
          (std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22)) + ((a & b) ^ (a & c) ^ (b & c));
      h = g, g = f, f = e, e = d + t1, d = c, c = b, b = a, a = t1 + t2;
    }
    const std::array<Word, 8> change{a, b, c, d, e, f, g, h};
    for (size_t i = 0; i < 8; ++i) state_[i] += change[i];
  }

  std::array<Word, 8> state_ = prime_roots<2, 8>();
  std::array<unsigned char, 64> buffer_{};
  size_t filled_ = 0;
  std::uint64_t length_ = 0;
};

const unsigned char* bytes_of(const char* text) {
  return reinterpret_cast<const unsigned char*>(text);
}

}  // namespace

std::string sha256(std::string_view bytes) {
  Sha256 hash;
  hash.add(bytes_of(bytes.data()), bytes.size());
  return hash.finish();
}

std::string sha256_of_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  Sha256 hash;
  std::vector<char> buffer(1 << 20);
  while (stream) {
    stream.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    hash.add(bytes_of(buffer.data()), static_cast<size_t>(stream.gcount()));
  }
  if (!stream.eof())
    throw std::filesystem::filesystem_error("cannot read", file,
                                            std::make_error_code(std::errc::io_error));
  return hash.finish();
}

std::filesystem::path checksum_file(const std::filesystem::path& file) {
  std::filesystem::path list = file;
  return list += ".sha256";
}

void write_checksum(const std::filesystem::path& file) {
  write_text_durably(checksum_file(file),
                     sha256_of_file(file) + "  " + file.filename().string() + "\n");
}

ChecksumState verify_checksum(const std::filesystem::path& file) {
  std::ifstream stream(checksum_file(file));
  if (!stream) return ChecksumState::missing;
  std::string sum, name;
  stream >> sum >> name;
  return sum == sha256_of_file(file) ? ChecksumState::matches : ChecksumState::differs;
}

}  // namespace drape
