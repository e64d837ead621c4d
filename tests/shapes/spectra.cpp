#include "shapes/spectra.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace tufted::shapes {
namespace {

using std::numbers::pi;

VectorXd smallest(std::vector<double> values, int count) {
  std::sort(values.begin(), values.end());
  return Eigen::Map<VectorXd>(values.data(), std::min<Eigen::Index>(count, values.size()));
}

// J'_m by Bessel's integral. For a periodic integrand the trapezoidal rule converges faster than any power.
double besselDerivative(int m, double x) {
  constexpr int steps = 256;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double tau = 2 * pi * i / steps;
    sum += std::sin(tau) * std::sin(m * tau - x * std::sin(tau));
  }
  return sum / steps;
}

double bisect(int m, double low, double high) {
  const bool rising = besselDerivative(m, low) < 0;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    ((besselDerivative(m, middle) < 0) == rising ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace

VectorXd sphereSpectrum(int count) {
  VectorXd values(count);
  for (int i = 0; i < count; ++i) {
    const int l = static_cast<int>(std::floor(std::sqrt(i + 0.5)));
    values[i] = l * (l + 1);
  }
  return values;
}

VectorXd rectangleSpectrum(double width, double height, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) values.push_back(pi * pi * (i * i / (width * width) + j * j / (height * height)));
  }
  return smallest(values, count);
}

VectorXd diskSpectrum(int count) {
  // By Weyl's law, N(lambda) = lambda / 4 + sqrt(lambda) / 2 + ..., zeros up to this limit suffice.
  const double limit = 2 * std::sqrt(static_cast<double>(count)) + 4;
  constexpr double step = 0.05;  // far less than the distance of zeros, about pi
  std::vector<double> values{0};
  for (int m = 0; m < limit; ++m) {
    for (double x = 0.5 * step; x < limit; x += step) {
      if (besselDerivative(m, x) * besselDerivative(m, x + step) > 0) continue;
      if (m > 1 && x + step < m) continue;  // there are no zeros below m, where J'_m is lost in rounding
      const double zero = bisect(m, x, x + step);
      values.insert(values.end(), m == 0 ? 1 : 2, zero * zero);
    }
  }
  return smallest(values, count);
}

VectorXd torusSpectrum(double major_radius, double minor_radius, int count) {
  // u = f(b) e^(i m phi) with w = R + r cos b: Rayleigh quotient of w (f'/r)^2 + m^2 f^2 / w and w f^2.
  constexpr int waves = 32, basis = 2 * waves + 1, steps = 256;
  std::vector<double> values;
  for (int m = 0; m * m < 4 * count; ++m) {
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(basis, basis), mass = stiffness;
    for (int i = 0; i < steps; ++i) {
      const double b = 2 * pi * i / steps, w = major_radius + minor_radius * std::cos(b);
      VectorXd f(basis), df(basis);
      f[0] = 1, df[0] = 0;
      for (int k = 1; k <= waves; ++k) {
        f[2 * k - 1] = std::cos(k * b), df[2 * k - 1] = -k * std::sin(k * b);
        f[2 * k] = std::sin(k * b), df[2 * k] = k * std::cos(k * b);
      }
      stiffness += w / (minor_radius * minor_radius) * df * df.transpose() + m * m / w * f * f.transpose();
      mass += w * f * f.transpose();
    }
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness, mass, Eigen::EigenvaluesOnly);
    for (int i = 0; i < waves; ++i) {
      values.insert(values.end(), m == 0 ? 1 : 2, std::max(0.0, solver.eigenvalues()[i]));
    }
  }
  VectorXd result = smallest(values, count);
  result[0] = 0;
  return result;
}

VectorXd bookSpectrum(int pages, double width, double height, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) {
      const double along = j * j / (height * height);
      values.push_back(pi * pi * (i * i / (width * width) + along));
      values.insert(values.end(), pages - 1, pi * pi * ((i + 0.5) * (i + 0.5) / (width * width) + along));
    }
  }
  return smallest(values, count);
}

VectorXd repeatedSpectrum(const VectorXd& spectrum, int copies) {
  VectorXd values(spectrum.size() * copies);
  for (Eigen::Index i = 0; i < values.size(); ++i) values[i] = spectrum[i / copies];
  return values;
}

PoissonProblem spherePoisson(const Points& points) {
  const auto x = points.col(0).array(), z = points.col(2).array();
  const Eigen::ArrayXd u = z * x.exp();
  // Delta on the sphere is Delta u - u_rr - 2 u_r with u_rr = (2 x + x^2) u and u_r = (1 + x) u.
  return {u, -u * (1 - (2 * x + x.square()) - 2 * (1 + x))};
}

}  // namespace tufted::shapes
