#include "estimation/parameter_space.h"

#include <cmath>

namespace drape {

bool is_logarithmic(Parameter parameter) {
  return parameter != Parameter::t_bu && parameter != Parameter::t_bv &&
         parameter != Parameter::t_bh;
}

VecX ParameterSpace::encode(const Fabric& fabric) const {
  VecX z(size());
  for (int i = 0; i < size(); ++i) {
    const Parameter p = parameters[static_cast<size_t>(i)];
    z[i] = is_logarithmic(p) ? std::log(fabric[p]) : fabric[p];
  }
  return z;
}

Fabric ParameterSpace::decode(const VecX& z) const {
  Fabric fabric = reference;
  for (int i = 0; i < size(); ++i) {
    const Parameter p = parameters[static_cast<size_t>(i)];
    fabric[p] = is_logarithmic(p) ? std::exp(z[i]) : z[i];
  }
  validate(fabric);
  return fabric;
}

VecX ParameterSpace::derivative(const VecX& z) const {
  VecX d(size());
  for (int i = 0; i < size(); ++i)
    d[i] = is_logarithmic(parameters[static_cast<size_t>(i)]) ? std::exp(z[i]) : 1.0;
  return d;
}

}  // namespace drape
