// Sparse symmetric systems for tests of the iterative solvers: a matrix in rows as an operator of the
// project, its copy for Eigen, and the 5-point Laplacian.
#pragma once
#include <Eigen/SparseCore>

#include <vector>

#include "kernels/linear/vectors.hpp"

namespace freshet::test {

using EigenRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

inline Field<double> to_field(const Eigen::VectorXd& v) {
  Field<double> f("test.vector", static_cast<size_t>(v.size()));
  for (int i = 0; i < v.size(); ++i) f(i) = v[i];
  return f;
}
inline Eigen::VectorXd to_eigen(const Field<double>& f, int n) {
  return Eigen::Map<const Eigen::VectorXd>(f.data(), n);
}

// y := A x, returns x.Ax.
class RowOperator {
 public:
  explicit RowOperator(EigenRows matrix) : matrix_(std::move(matrix)) { matrix_.makeCompressed(); }

  double operator()(const Field<double>& x, const Field<double>& y) const {
    const int* start = matrix_.outerIndexPtr();
    const int* column = matrix_.innerIndexPtr();
    const double* value = matrix_.valuePtr();
    return sum_of_particles<1>("test::rows", size(), [=](int i) {
      double sum = 0;
      for (int k = start[i]; k < start[i + 1]; ++k) sum += value[k] * x(column[k]);
      y(i) = sum;
      return Addends<1>{{x(i) * sum}};
    })[0];
  }

  int size() const { return static_cast<int>(matrix_.rows()); }
  const EigenRows& matrix() const { return matrix_; }
  Field<double> inverse_diagonal() const { return to_field(matrix_.diagonal().cwiseInverse()); }

 private:
  EigenRows matrix_;
};

// mass on the diagonal, and conductance(a, b) between neighbouring nodes of an nx x ny grid, numbered x
// fastest.
template <class Conductance>
EigenRows five_points(int nx, int ny, double mass, const Conductance& conductance) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto couple = [&](int a, int b) {
    const double k = conductance(a, b);
    for (const auto& [row, column] : {std::pair(a, b), std::pair(b, a)}) {
      entries.emplace_back(row, row, k);
      entries.emplace_back(row, column, -k);
    }
  };
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const int a = j * nx + i;
      entries.emplace_back(a, a, mass);
      if (i + 1 < nx) couple(a, a + 1);
      if (j + 1 < ny) couple(a, a + nx);
    }
  EigenRows matrix(nx * ny, nx * ny);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace freshet::test
