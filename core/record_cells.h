// How a value of a record lies on disk: the type of its elements, and the way there and back.
//
// Part of records.cpp.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "core/hdf5_file.h"
#include "core/record_columns.h"

namespace drape {

/// Coverage is stored as u16.
inline constexpr double kFullCoverage = std::numeric_limits<std::uint16_t>::max();

inline hsize_t size_of(const hdf5::Shape& cell) {
  return std::accumulate(cell.begin(), cell.end(), hsize_t{1}, std::multiplies<>());
}

/// A number or a text: one element.
template <class Value>
struct Stored {
  using Element = std::conditional_t<std::is_same_v<Value, bool>, std::uint8_t, Value>;
  static void append(const Value& value, const Column&, std::vector<Element>& elements) {
    elements.push_back(static_cast<Element>(value));
  }
  static void take(const Element* element, const hdf5::Shape&, Value& value) {
    value = static_cast<Value>(*element);
  }
};

template <>
struct Stored<VecX> {
  using Element = double;
  static void append(const VecX& value, const Column& column, std::vector<double>& elements) {
    if (static_cast<hsize_t>(value.size()) != size_of(column.cell))
      throw std::invalid_argument(column.path + " has " + std::to_string(value.size()) +
                                  " values, must have " + std::to_string(size_of(column.cell)));
    elements.insert(elements.end(), value.begin(), value.end());
  }
  static void take(const double* elements, const hdf5::Shape& cell, VecX& value) {
    value = Eigen::Map<const VecX>(elements, static_cast<Eigen::Index>(size_of(cell)));
  }
};

template <>
struct Stored<CoverageImage> {
  using Element = std::uint16_t;
  static void append(const CoverageImage& value, const Column& column,
                     std::vector<Element>& elements) {
    const hdf5::Shape shape{static_cast<hsize_t>(value.rows()), static_cast<hsize_t>(value.cols())};
    if (shape != column.cell)
      throw std::invalid_argument(column.path + " is " + hdf5::to_string(shape) +
                                  ", must be as the grid, " + hdf5::to_string(column.cell));
    for (const double share : value.reshaped<Eigen::RowMajor>()) {
      if (!(share >= 0 && share <= 1))
        throw std::invalid_argument(column.path + " holds " + std::to_string(share) +
                                    ", must be within [0, 1]");
      elements.push_back(static_cast<Element>(std::lround(share * kFullCoverage)));
    }
  }
  static void take(const Element* elements, const hdf5::Shape& cell, CoverageImage& value) {
    using Image = Eigen::Matrix<Element, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    value = Eigen::Map<const Image>(elements, static_cast<Eigen::Index>(cell[0]),
                                    static_cast<Eigen::Index>(cell[1]))
                .cast<double>() /
            kFullCoverage;
  }
};

template <class Row, class Place>
using ValueAt = std::remove_cvref_t<std::invoke_result_t<Place, Row&>>;

inline hdf5::Shape table_shape(size_t count, const Column& column) {
  hdf5::Shape shape{count};
  shape.insert(shape.end(), column.cell.begin(), column.cell.end());
  return shape;
}

}  // namespace drape
