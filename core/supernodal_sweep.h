// Forward and backward substitution with a supernodal Cholesky factor, one right-hand side.
//
// For a single right-hand side the substitution is bound by reading the factor once down and once
// up; four columns at a time and one pass over each supernode come close to that bound, where
// calls of a BLAS for every supernode do not.
#pragma once

namespace drape {

/// A factor L, stored as dense column-major panels. Supernode s owns the columns first_column[s] to
/// first_column[s + 1] and the rows rows[row_start[s]] to rows[row_start[s + 1]] (ascending, its
/// own columns first); its panel begins at values[value_start[s]].
struct Supernodes {
  int count;
  const int *first_column, *row_start, *value_start, *rows;
  const double* values;
};

/// y <- L^-T L^-1 y. inverse_diagonal: 1 / L(j, j); panel: workspace for the longest row list.
void solve_supernodal(const Supernodes& L, const double* inverse_diagonal, double* y,
                      double* panel);

}  // namespace drape
