#include <cholmod.h>
#include <omp.h>

#include <stdexcept>

#include "tests/bench/peers.hpp"

extern "C" {
char* openblas_get_config();
void openblas_set_num_threads(int threads);
}

namespace isojam::bench {

struct CholmodFactor::Workspace {
  cholmod_common common{};
  cholmod_sparse matrix{};
  cholmod_factor* factor = nullptr;
};

CholmodFactor::CholmodFactor(const Eigen::SparseMatrix<double>& lower_half)
    : lower_half_(lower_half), workspace_(std::make_unique<Workspace>()) {
  openblas_set_num_threads(1);
  cholmod_start(&workspace_->common);
  workspace_->common.supernodal = CHOLMOD_SUPERNODAL;
  cholmod_sparse& matrix = workspace_->matrix;
  matrix.nrow = matrix.ncol = static_cast<std::size_t>(lower_half_.rows());
  matrix.nzmax = static_cast<std::size_t>(lower_half_.nonZeros());
  // CHOLMOD only reads these arrays.
  matrix.p = lower_half_.outerIndexPtr();
  matrix.i = lower_half_.innerIndexPtr();
  matrix.x = lower_half_.valuePtr();
  matrix.stype = -1;
  matrix.itype = CHOLMOD_INT;
  matrix.xtype = CHOLMOD_REAL;
  matrix.dtype = CHOLMOD_DOUBLE;
  matrix.sorted = matrix.packed = 1;
  workspace_->factor = cholmod_analyze(&matrix, &workspace_->common);
  if (!workspace_->factor) throw std::runtime_error("CHOLMOD cannot analyse the pattern");
}

CholmodFactor::~CholmodFactor() {
  cholmod_free_factor(&workspace_->factor, &workspace_->common);
  cholmod_finish(&workspace_->common);
}

bool CholmodFactor::factorise() {
  // CHOLMOD requests four threads from OpenMP even if another number is set; this limits it to one.
  omp_set_max_active_levels(0);
  const int done = cholmod_factorize(&workspace_->matrix, workspace_->factor, &workspace_->common);
  return done != 0 && workspace_->common.status == CHOLMOD_OK;
}

Eigen::VectorXd CholmodFactor::solve(const Eigen::VectorXd& b) {
  Eigen::VectorXd right_side = b;
  const auto rows = static_cast<std::size_t>(b.size());
  cholmod_dense dense{rows, 1, rows, rows, right_side.data(), nullptr, CHOLMOD_REAL, CHOLMOD_DOUBLE};
  cholmod_dense* solution = cholmod_solve(CHOLMOD_A, workspace_->factor, &dense, &workspace_->common);
  if (!solution) throw std::runtime_error("CHOLMOD cannot solve");
  Eigen::VectorXd result = Eigen::Map<const Eigen::VectorXd>(static_cast<const double*>(solution->x), b.size());
  cholmod_free_dense(&solution, &workspace_->common);
  return result;
}

std::string blas_in_use() { return openblas_get_config(); }

}  // namespace isojam::bench
