#include "core/sparse_factor.h"

#include <Eigen/SparseCholesky>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string>

#ifdef DRAPE_WITH_CHOLMOD
#include <cholmod.h>

#include "core/blas_call.h"
#include "core/supernodal_sweep.h"
#endif

namespace drape {
namespace {

using EigenFactor = Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>>;
constexpr int kInverseIterations = 60;

}  // namespace

#ifdef DRAPE_WITH_CHOLMOD
namespace {

void start(cholmod_common& common) {
  cholmod_start(&common);
  common.supernodal = CHOLMOD_SUPERNODAL;
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_NATURAL;
  common.postorder = 1;
  common.quick_return_if_not_posdef = 1;
  common.nrelax[0] = 8;  // measured: smaller relaxed supernodes suit the 3x3 blocks
  common.print = 0;
}

/// CHOLMOD's view of a matrix that stays ours.
cholmod_sparse view(const SparseMatrix& lower) {
  cholmod_sparse A{};
  A.nrow = A.ncol = static_cast<size_t>(lower.rows());
  A.nzmax = static_cast<size_t>(lower.nonZeros());
  A.p = const_cast<int*>(lower.outerIndexPtr());
  A.i = const_cast<int*>(lower.innerIndexPtr());
  A.x = const_cast<double*>(lower.valuePtr());
  A.stype = -1;
  A.itype = CHOLMOD_INT;
  A.xtype = CHOLMOD_REAL;
  A.dtype = CHOLMOD_DOUBLE;
  A.sorted = A.packed = 1;
  return A;
}

}  // namespace

struct SymbolicFactor::Cholmod {
  mutable cholmod_common common{};
  cholmod_factor* factor = nullptr;
  ~Cholmod() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
};

struct SparseFactor::Numeric {
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  std::unique_ptr<EigenFactor> eigen;
  bool valid = false;
  VecX inverse_diagonal, permuted, panel;  // of solve_in_place
  Numeric() { start(common); }
  ~Numeric() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }

  Supernodes supernodes() const {
    const auto ints = [](const void* p) { return static_cast<const int*>(p); };
    return {static_cast<int>(factor->nsuper),
            ints(factor->super),
            ints(factor->pi),
            ints(factor->px),
            ints(factor->s),
            static_cast<const double*>(factor->x)};
  }

  void prepare_solves() {
    const Supernodes L = supernodes();
    const auto n = static_cast<Eigen::Index>(factor->n);
    inverse_diagonal.resize(n);
    permuted.resize(n);
    panel.resize(static_cast<Eigen::Index>(factor->maxesize + factor->n));
    for (int s = 0; s < L.count; ++s) {
      const int first = L.first_column[s], rows = L.row_start[s + 1] - L.row_start[s];
      for (int j = first; j < L.first_column[s + 1]; ++j)
        inverse_diagonal[j] =
            1 / L.values[L.value_start[s] + static_cast<std::ptrdiff_t>(j - first) * (rows + 1)];
    }
  }

  void solve(VecX& x) {
    const int* const order = static_cast<const int*>(factor->Perm);
    for (Eigen::Index i = 0; i < x.size(); ++i) permuted[i] = x[order[i]];
    solve_supernodal(supernodes(), inverse_diagonal.data(), permuted.data(), panel.data());
    for (Eigen::Index i = 0; i < x.size(); ++i) x[order[i]] = permuted[i];
  }
};
#else
struct SymbolicFactor::Cholmod {};
struct SparseFactor::Numeric {
  std::unique_ptr<EigenFactor> eigen;
  bool valid = false;
};
#endif

FactorBackend default_factor_backend() {
#ifdef DRAPE_WITH_CHOLMOD
  return FactorBackend::cholmod;
#else
  return FactorBackend::eigen;
#endif
}

std::string_view name(FactorBackend backend) {
  return backend == FactorBackend::cholmod ? "cholmod" : "eigen";
}

FactorBackend factor_backend_from_name(std::string_view text) {
  if (text == "eigen") return FactorBackend::eigen;
#ifdef DRAPE_WITH_CHOLMOD
  if (text == "cholmod") return FactorBackend::cholmod;
  constexpr std::string_view kKnown = "\"cholmod\" or \"eigen\"";
#else
  constexpr std::string_view kKnown = "\"eigen\" (this build is without CHOLMOD)";
#endif
  throw std::invalid_argument("factorization '" + std::string(text) + "': must be " +
                              std::string(kKnown));
}

SymbolicFactor::SymbolicFactor(const SparseMatrix& pattern, FactorBackend backend)
    : backend_(backend), size_(pattern.rows()) {
#ifdef DRAPE_WITH_CHOLMOD
  if (backend == FactorBackend::cholmod) {
    cholmod_ = std::make_unique<Cholmod>();
    start(cholmod_->common);
    const BlasCall alone;
    cholmod_sparse A = view(pattern);
    cholmod_->factor = cholmod_analyze(&A, &cholmod_->common);
    if (cholmod_->factor == nullptr)
      throw std::runtime_error("sparse factorisation: CHOLMOD's analysis failed");
    return;
  }
#endif
  SparseMatrix ones = pattern;
  for (Eigen::Index i = 0; i < ones.nonZeros(); ++i) ones.valuePtr()[i] = 0;
  ones.diagonal().setOnes();
  const EigenFactor factor(ones);
  eigen_nonzeros_ = static_cast<double>(factor.matrixL().nestedExpression().nonZeros());
}

SymbolicFactor::~SymbolicFactor() = default;

double SymbolicFactor::nonzeros() const {
#ifdef DRAPE_WITH_CHOLMOD
  if (backend_ == FactorBackend::cholmod) return static_cast<double>(cholmod_->factor->xsize);
#endif
  return eigen_nonzeros_;
}

SparseFactor::SparseFactor(std::shared_ptr<const SymbolicFactor> symbolic)
    : symbolic_(std::move(symbolic)), numeric_(std::make_unique<Numeric>()) {
#ifdef DRAPE_WITH_CHOLMOD
  if (symbolic_->backend() == FactorBackend::cholmod) {
    numeric_->factor = cholmod_copy_factor(symbolic_->cholmod_->factor, &numeric_->common);
    if (numeric_->factor == nullptr)
      throw std::runtime_error("sparse factorisation: out of memory");
    return;
  }
#endif
  numeric_->eigen = std::make_unique<EigenFactor>();
}

SparseFactor::~SparseFactor() = default;

bool SparseFactor::factorize(const SparseMatrix& lower) {
  numeric_->valid = false;
  // CHOLMOD takes a pivot that is not a number for a positive one
  if (!Eigen::Map<const VecX>(lower.valuePtr(), lower.nonZeros()).allFinite()) return false;
#ifdef DRAPE_WITH_CHOLMOD
  if (symbolic_->backend() == FactorBackend::cholmod) {
    const BlasCall alone;
    cholmod_sparse A = view(lower);
    cholmod_factorize(&A, numeric_->factor, &numeric_->common);
    if (numeric_->common.status < CHOLMOD_OK)
      throw std::runtime_error("sparse factorisation: CHOLMOD failed with status " +
                               std::to_string(numeric_->common.status));
    numeric_->valid =
        numeric_->common.status == CHOLMOD_OK && numeric_->factor->minor == numeric_->factor->n;
    if (numeric_->valid) numeric_->prepare_solves();
    return numeric_->valid;
  }
#endif
  numeric_->eigen->compute(lower);
  numeric_->valid =
      numeric_->eigen->info() == Eigen::Success && (numeric_->eigen->vectorD().array() > 0).all();
  return numeric_->valid;
}

MatX SparseFactor::solve(const MatX& right_hand_sides) const {
  if (!numeric_->valid) throw std::logic_error("sparse factorisation: solve without a factor");
#ifdef DRAPE_WITH_CHOLMOD
  if (symbolic_->backend() == FactorBackend::cholmod) {
    const BlasCall alone;
    cholmod_dense B{};
    B.nrow = B.d = static_cast<size_t>(right_hand_sides.rows());
    B.ncol = static_cast<size_t>(right_hand_sides.cols());
    B.nzmax = B.nrow * B.ncol;
    B.x = const_cast<double*>(right_hand_sides.data());
    B.xtype = CHOLMOD_REAL;
    B.dtype = CHOLMOD_DOUBLE;
    cholmod_dense* X = cholmod_solve(CHOLMOD_A, numeric_->factor, &B, &numeric_->common);
    if (X == nullptr) throw std::runtime_error("sparse factorisation: CHOLMOD's solve failed");
    const MatX solution = Eigen::Map<const MatX>(static_cast<const double*>(X->x),
                                                 right_hand_sides.rows(), right_hand_sides.cols());
    cholmod_free_dense(&X, &numeric_->common);
    return solution;
  }
#endif
  return numeric_->eigen->solve(right_hand_sides);
}

void SparseFactor::solve_in_place(VecX& x) const {
  if (!numeric_->valid) throw std::logic_error("sparse factorisation: solve without a factor");
#ifdef DRAPE_WITH_CHOLMOD
  if (symbolic_->backend() == FactorBackend::cholmod) return numeric_->solve(x);
#endif
  x = numeric_->eigen->solve(x);
}

int negative_eigenvalues(const SparseMatrix& lower) {
  const EigenFactor factor(lower);
  if (factor.info() != Eigen::Success) return -1;
  return static_cast<int>((factor.vectorD().array() < 0).count());
}

double smallest_eigenvalue(const SparseFactor& factor) {
  VecX v(factor.size());
  for (Eigen::Index i = 0; i < v.size(); ++i) v[i] = std::sin(1.0 + static_cast<double>(i));
  v.normalize();
  double inverse = 1;
  for (int i = 0; i < kInverseIterations; ++i) {
    VecX w = v;
    factor.solve_in_place(w);
    inverse = v.dot(w);
    v = w.normalized();
  }
  return 1 / inverse;
}

}  // namespace drape
