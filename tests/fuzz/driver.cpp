// Without libFuzzer: reads the inputs of a corpus as they are, then mutations of them.
//
//     driver CORPUS [SEED [MUTATIONS [SECONDS]]]
//
// The mutations follow from the seed alone; the time only says when to stop.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iterator>
#include <random>
#include <vector>

#include <sys/resource.h>
#include <unistd.h>

#include "tests/fuzz/input.hpp"

namespace {

using Clock = std::chrono::steady_clock;
using Input = std::string;

constexpr unsigned longest_read = 10;            // [s] with sanitizers and neighbours
constexpr rlim_t most_memory = rlim_t{1} << 29;  // [B] of addresses
constexpr std::size_t longest_input = 1 << 15;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

std::vector<Input> read_corpus(const std::string& folder) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<Input> corpus;
  for (const auto& path : paths) {
    std::ifstream file(path, std::ios::binary);
    corpus.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return corpus;
}

class Mutator {
 public:
  Mutator(std::vector<Input> corpus, unsigned seed) : corpus_(std::move(corpus)), random_(seed) {}

  Input next() {
    Input input = any();
    for (std::size_t n = 1 + below(4); n > 0; --n) mutate(input);
    if (input.size() > longest_input) input.resize(longest_input);
    return input;
  }

 private:
  std::size_t below(std::size_t bound) { return bound > 0 ? random_() % bound : 0; }
  const Input& any() { return corpus_[below(corpus_.size())]; }
  Input piece(const Input& from, std::size_t longest) {
    const std::size_t begin = below(from.size());
    return from.substr(begin, 1 + below(longest));
  }

  void mutate(Input& input) {
    static const char* const tokens[] = {
        "1e999",   "-1",   "0",  "nan",  "1e-320", "99999999999", "[",    "]",           "{",
        "}",       ": ",   "- ", "&a ",  "*a",     "\n",          "\r\n", ",",           "\"",
        "'",       "#",    "? ", "| ",   "!!x ",   "---",         "%",    "<a>",         "<",
        "</link>", "&lt;", "\t", "\xFF", "..",     "/",           "null", "\xEF\xBB\xBF"};
    const std::size_t at = below(input.size() + 1);
    switch (random_() % 6) {
      case 0:
        if (at < input.size()) input[at] = static_cast<char>(input[at] ^ (1 << below(8)));
        break;
      case 1:
        input.resize(at);
        break;
      case 2:
        input.erase(at, 1 + below(20));
        break;
      case 3:
        input.insert(at, piece(any(), 60));
        break;
      case 4:
        input.insert(at, tokens[below(std::size(tokens))]);
        break;
      default: {
        const Input repeated = piece(input, 8);
        for (std::size_t n = 1 + below(200); n > 0; --n) input.insert(at, repeated);
      }
    }
  }

  std::vector<Input> corpus_;
  std::mt19937 random_;
};

void read(const Input& input) {
  alarm(longest_read);
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
  alarm(0);
}

#ifdef SEAM_LIMIT_MEMORY  // sanitizers reserve terabytes
void limit_memory() {
  const rlimit limit{most_memory, most_memory};
  setrlimit(RLIMIT_AS, &limit);
}
#else
void limit_memory() {}
#endif

}  // namespace

int main(int argc, char** argv) {
  const std::vector<Input> corpus = read_corpus(argc > 1 ? argv[1] : ".");
  const auto number = [&](int i, double otherwise) {
    return argc > i ? std::strtod(argv[i], nullptr) : otherwise;
  };
  const auto seed = static_cast<unsigned>(number(2, 1));
  const double most = number(3, 5000);
  const double time = number(4, 2.0);
  if (corpus.empty()) return std::puts("no corpus"), 1;
  std::printf("seed %u\n", seed);
  std::fflush(stdout);
  limit_memory();
  for (const Input& input : corpus) read(input);
  Mutator mutator(corpus, seed);
  int done = 0;
  for (const auto begin = Clock::now(); done < most && seconds_since(begin) < time; ++done)
    read(mutator.next());
  std::printf("%zu inputs, %d mutations\n", corpus.size(), done);
}
