// tests/support/replay_corpus.cpp: feeds every file of the given folders, and a bounded number of
// damaged copies of them, to a fuzz target; the same ones each time.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr int kDamagedCopies = 2000;
constexpr int kMostDamages = 4;  // to one copy

std::vector<Bytes> readCorpus(int argc, char** argv) {
  std::vector<std::filesystem::path> files;
  for (int i = 1; i < argc; ++i)
    for (const auto& entry : std::filesystem::recursive_directory_iterator(argv[i]))
      if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());  // folders are listed in any order
  std::vector<Bytes> corpus;
  for (const auto& path : files) {
    std::ifstream file(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    corpus.emplace_back(text.begin(), text.end());
  }
  return corpus;
}

/// Flips a bit, sets a byte, cuts the end, drops, doubles or zeroes a stretch.
void damage(Bytes& bytes, std::mt19937& random) {
  if (bytes.empty()) return;
  const auto below = [&](std::size_t limit) { return random() % limit; };
  const std::size_t at = below(bytes.size());
  const std::size_t length = 1 + below(std::min<std::size_t>(16, bytes.size() - at));
  const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(at);
  const auto end = begin + static_cast<std::ptrdiff_t>(length);
  switch (below(6)) {
    case 0:
      bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ (1U << below(8)));
      return;
    case 1:
      bytes[at] = static_cast<std::uint8_t>(below(256));
      return;
    case 2:
      bytes.resize(at);
      return;
    case 3:
      bytes.erase(begin, end);
      return;
    case 4: {
      const Bytes stretch(begin, end);
      bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at), stretch.begin(), stretch.end());
      return;
    }
    default:
      std::fill(begin, end, std::uint8_t{0});
  }
}

void feed(Bytes bytes) {
  bytes.shrink_to_fit();  // so that a sanitizer sees the first byte behind the end
  LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<Bytes> corpus = readCorpus(argc, argv);
  if (corpus.empty()) {
    std::cout << "the corpus is empty, which tests nothing\n";
    return 1;
  }
  for (const Bytes& bytes : corpus) feed(bytes);
  std::mt19937 random(1);
  for (int copy = 0; copy < kDamagedCopies; ++copy) {
    Bytes bytes = corpus[static_cast<std::size_t>(copy) % corpus.size()];
    const unsigned damages = 1 + random() % kMostDamages;
    for (unsigned i = 0; i < damages; ++i) damage(bytes, random);
    feed(std::move(bytes));
  }
  std::cout << corpus.size() << " files of the corpus and " << kDamagedCopies
            << " damaged copies read\n";
}
