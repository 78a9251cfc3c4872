#include <oneapi/tbb/global_control.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "engine/solve/factor/block_cholesky.hpp"
#include "tests/engine/solve/scattered_blocks.hpp"
#include "tests/engine/solve/solve_support.hpp"

// The sanitizers replace malloc, so this test cannot replace it too.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace {
// NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables): settings that malloc reads
std::atomic<bool> counting{false};
std::atomic<long> calls{0}, refused{0};
// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)

bool refuses() { return counting.load() && ++calls == refused.load(); }
}  // namespace

// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming,readability-inconsistent-declaration-parameter-name)
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);

void* malloc(std::size_t size) { return refuses() ? nullptr : __libc_malloc(size); }
void* calloc(std::size_t count, std::size_t size) { return refuses() ? nullptr : __libc_calloc(count, size); }
void* realloc(void* old, std::size_t size) { return refuses() ? nullptr : __libc_realloc(old, size); }
}
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming,readability-inconsistent-declaration-parameter-name)

namespace isojam {
namespace {

enum class Came { through, short_of_memory };

/// Factorises, while the k-th allocation fails; with k = 0, none fails.
Came factorise(BlockCholesky& factor, const BlockMatrix& matrix, long k) {
  calls = 0;
  refused = k;
  counting = true;
  try {
    const bool done = factor.factorise(matrix, safe_shift);
    counting = false;
    EXPECT_TRUE(done);
    return Came::through;
  } catch (const std::bad_alloc&) {
    counting = false;
    return Came::short_of_memory;
  }
}

void refuse_one_after_the_other(int n, std::size_t threads) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  const BlockMatrix matrix = scattered_blocks(n, 9);
  BlockMatrix before = matrix;  // A matrix that needs less memory.
  std::erase_if(before.off_diagonal, [](const BlockMatrix::Block& block) { return block.column % 3 == 0; });
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(Eigen::Index{6} * n, -1, 1);
  BlockCholesky fresh;
  factorise(fresh, matrix, 0);
  const long asked = calls;
  const Eigen::VectorXd expected = fresh.solve(b);
  long tried = 0, short_of_memory = 0;
  for (long k = 1; k <= asked; k += std::max(1L, asked / 200)) {
    ++tried;
    BlockCholesky factor;
    ASSERT_EQ(factorise(factor, before, 0), Came::through);
    if (factorise(factor, matrix, k) == Came::short_of_memory) {
      ++short_of_memory;
      ASSERT_EQ(factorise(factor, matrix, 0), Came::through);
    }
    ASSERT_TRUE(factor.solve(b) == expected) << "call " << k;
  }
  std::printf("N %d, %zu threads: %ld of %ld refusals of %ld calls ended early\n", n, threads, short_of_memory, tried,
              asked);
  EXPECT_GT(2 * short_of_memory, tried);
}

TEST(FactorOutOfMemory, SmallMatrices) { refuse_one_after_the_other(60, 1); }
TEST(FactorOutOfMemory, DissectedMatrices) { refuse_one_after_the_other(400, 1); }
TEST(FactorOutOfMemory, DissectedMatricesOnTwoThreads) { refuse_one_after_the_other(400, 2); }

}  // namespace
}  // namespace isojam

#else

TEST(FactorOutOfMemory, NotWithSanitizers) { GTEST_SKIP() << "a sanitizer has malloc for itself"; }

#endif
