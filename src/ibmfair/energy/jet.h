// Numbers with derivatives, for forward automatic differentiation.
#pragma once

#include <array>

namespace ibmfair {

/// A value and its derivatives with respect to n variables. Arithmetic applies the chain rule.
template <int n>
struct Jet {
  double value = 0;
  std::array<double, n> derivative{};

  Jet() = default;
  Jet(double constant) : value(constant) {}  // NOLINT(google-explicit-constructor): as numbers do

  /// The i-th variable.
  static Jet variable(double value, int i) {
    Jet x(value);
    x.derivative[i] = 1;
    return x;
  }
};

/// The jet of a function of a and b, from its value and its derivatives with respect to a and b.
template <int n>
Jet<n> chained(double value, double by_a, const Jet<n>& a, double by_b, const Jet<n>& b) {
  Jet<n> result(value);
  for (int i = 0; i < n; ++i) {
    result.derivative[i] = by_a * a.derivative[i] + by_b * b.derivative[i];
  }
  return result;
}

template <int n>
Jet<n> operator+(const Jet<n>& a, const Jet<n>& b) {
  return chained(a.value + b.value, 1, a, 1, b);
}

template <int n>
Jet<n> operator-(const Jet<n>& a, const Jet<n>& b) {
  return chained(a.value - b.value, 1, a, -1, b);
}

template <int n>
Jet<n> operator*(const Jet<n>& a, const Jet<n>& b) {
  return chained(a.value * b.value, b.value, a, a.value, b);
}

template <int n>
Jet<n> operator*(double a, const Jet<n>& b) {
  return chained(a * b.value, a, b, 0, Jet<n>());
}

template <int n>
Jet<n> operator/(const Jet<n>& a, const Jet<n>& b) {
  const double quotient = a.value / b.value;
  return chained(quotient, 1 / b.value, a, -quotient / b.value, b);
}

inline double value_of(double x) {
  return x;
}

template <int n>
double value_of(const Jet<n>& x) {
  return x.value;
}

}  // namespace ibmfair
