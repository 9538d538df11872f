#include "core/supernodal_sweep.h"

#include <algorithm>
#include <cstddef>

#include "core/lanes.h"

namespace drape {
namespace {

constexpr int kColumns = 4;  // at a time

Lanes load(const double* from) { return Lanes(from, std::experimental::element_aligned); }

/// t[0, rows) -= sum over kCount columns of value[c] * column c.
template <int kCount>
void subtract_columns(const double* columns, std::ptrdiff_t stride, const double* value, int rows,
                      double* t) {
  int i = 0;
  for (; i + kLanes <= rows; i += kLanes) {
    Lanes sum = load(t + i);
    for (int c = 0; c < kCount; ++c) sum -= value[c] * load(columns + c * stride + i);
    sum.copy_to(t + i, std::experimental::element_aligned);
  }
  for (; i < rows; ++i)
    for (int c = 0; c < kCount; ++c) t[i] -= value[c] * columns[c * stride + i];
}

/// sum[c] -= column c . t for kCount columns.
template <int kCount>
void subtract_products(const double* columns, std::ptrdiff_t stride, const double* t, int rows,
                       double* sum) {
  Lanes part[kCount];
  for (int c = 0; c < kCount; ++c) part[c] = 0.0;
  int i = 0;
  for (; i + kLanes <= rows; i += kLanes) {
    const Lanes x = load(t + i);
    for (int c = 0; c < kCount; ++c) part[c] += x * load(columns + c * stride + i);
  }
  for (int c = 0; c < kCount; ++c) sum[c] -= reduce(part[c]);
  for (; i < rows; ++i)
    for (int c = 0; c < kCount; ++c) sum[c] -= columns[c * stride + i] * t[i];
}

/// Columns j to j + kCount of a panel of `rows` rows: the triangle, then what is below it.
template <int kCount>
void forward(const double* panel, int rows, int j, const double* inverse_diagonal, double* t) {
  const double* const triangle = panel + static_cast<std::ptrdiff_t>(j) * rows + j;
  for (int c = 0; c < kCount; ++c) {
    t[j + c] *= inverse_diagonal[j + c];
    for (int r = c + 1; r < kCount; ++r)
      t[j + r] -= triangle[static_cast<std::ptrdiff_t>(c) * rows + r] * t[j + c];
  }
  subtract_columns<kCount>(triangle + kCount, rows, t + j, rows - j - kCount, t + j + kCount);
}

template <int kCount>
void backward(const double* panel, int rows, int j, const double* inverse_diagonal, double* t) {
  const double* const triangle = panel + static_cast<std::ptrdiff_t>(j) * rows + j;
  subtract_products<kCount>(triangle + kCount, rows, t + j + kCount, rows - j - kCount, t + j);
  for (int c = kCount - 1; c >= 0; --c) {
    for (int r = c + 1; r < kCount; ++r)
      t[j + c] -= triangle[static_cast<std::ptrdiff_t>(c) * rows + r] * t[j + r];
    t[j + c] *= inverse_diagonal[j + c];
  }
}

}  // namespace

void solve_supernodal(const Supernodes& L, const double* inverse_diagonal, double* y, double* t) {
  for (int s = 0; s < L.count; ++s) {
    const int first = L.first_column[s], columns = L.first_column[s + 1] - first;
    const int* const rows = L.rows + L.row_start[s];
    const int count = L.row_start[s + 1] - L.row_start[s];
    const double* const panel = L.values + L.value_start[s];
    const double* const inverse = inverse_diagonal + first;
    std::copy_n(y + first, columns, t);
    std::fill(t + columns, t + count, 0.0);
    int j = 0;
    for (; j + kColumns <= columns; j += kColumns) forward<kColumns>(panel, count, j, inverse, t);
    for (; j < columns; ++j) forward<1>(panel, count, j, inverse, t);
    std::copy_n(t, columns, y + first);
    for (int i = columns; i < count; ++i) y[rows[i]] += t[i];
  }
  for (int s = L.count - 1; s >= 0; --s) {
    const int first = L.first_column[s], columns = L.first_column[s + 1] - first;
    const int* const rows = L.rows + L.row_start[s];
    const int count = L.row_start[s + 1] - L.row_start[s];
    const double* const panel = L.values + L.value_start[s];
    const double* const inverse = inverse_diagonal + first;
    for (int i = 0; i < count; ++i) t[i] = y[rows[i]];
    int j = columns;
    for (; j % kColumns != 0; --j) backward<1>(panel, count, j - 1, inverse, t);
    for (; j > 0; j -= kColumns) backward<kColumns>(panel, count, j - kColumns, inverse, t);
    std::copy_n(t, columns, y + first);
  }
}

}  // namespace drape
