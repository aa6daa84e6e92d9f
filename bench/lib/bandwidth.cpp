// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Bytes per second of the loops of the linear solver beside those of
   STREAM-like ones, in arrays far beyond the cache. Counted is the traffic
   that cannot be avoided: each vector once, 12 bytes per matrix entry (value
   and column), row pointers, diagonal, x once, y once; as in STREAM, no
   reads for what is written. Best of several, in CPU time, so that a core
   that is shared is not a slow one; what others take of the memory's
   bandwidth is not seen. One line per loop: kernel dimension rows entries
   GB/s.
------------------------------------------------------------------------- */

#include "aleisph_solve_csr.h"
#include "aleisph_solve_krylov_loops.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

using namespace aleisph;

namespace {

using Vector = std::vector<double>;

double seconds()
{
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return now.tv_sec + 1.0e-9 * now.tv_nsec;
}

volatile double sink;    // what is written here must be computed

template <class Loop>
void report(const char *kernel, int dimension, double rows, double entries, double bytes,
            const Loop &loop)
{
  constexpr int REPEATS = 15;
  double best = INFINITY;
  for (int k = 0; k < REPEATS; k++) {
    const double start = seconds();
    loop();
    best = std::min(best, seconds() - start);
  }
  std::printf("%s %d %.0f %.0f %.4g\n", kernel, dimension, rows, entries, 1.0e-9 * bytes / best);
  std::fflush(stdout);
}

void stream(std::size_t n)
{
  Vector a(n, 1.0), b(n, 2.0), c(n, 0.5);
  const auto rows = static_cast<double>(n);
  report("triad", 1, rows, 0.0, 24.0 * rows, [&] {
    double *__restrict__ to = a.data();
    for (std::size_t i = 0; i < n; i++) to[i] = b[i] + 3.0 * c[i];
  });
  report("sum", 1, rows, 0.0, 8.0 * rows, [&] {
    double sum;
    sum_terms<1>(n, &sum, [&](auto at, auto *term) { *term = at(b.data()); });
    sink = sum;
  });
}

// the passes of an iteration of BiCGSTAB in their order
void vector_loops(std::size_t n)
{
  Vector x(n, 1.0), y(n, 0.5), z(n, 0.1), r(n, 1.0), r0(n, 1.0), p(n, 1.0), v(n, 0.2), t(n, 0.3);
  const auto rows = static_cast<double>(n);
  double sums[6];
  report("product-sums", 1, rows, 0.0, 16.0 * rows, [&] {
    product_sums(n, r0.data(), v.data(), sums);
    sink = sums[0];
  });
  report("half-step", 1, rows, 0.0, 24.0 * rows,
         [&] { half_step(n, 1.0e-3, v.data(), 0.1, r.data()); });
  report("stabilizer-sums", 1, rows, 0.0, 24.0 * rows, [&] {
    stabilizer_sums(n, t.data(), r.data(), r0.data(), sums);
    sink = sums[0];
  });
  const FullStep step = {1.0e-3, 1.0e-3, 0.5, 0.1, 0.1};
  report("full-step", 1, rows, 0.0, 80.0 * rows, [&] {
    full_step(n, step, y.data(), z.data(), t.data(), v.data(), x.data(), r.data(), p.data());
  });
}

struct Lattice {
  std::vector<int> ptr = {0}, col;

  // points of a lattice in the order of cells of the neighbor list, neighbours within 2.4 spacings
  // (cubic kernel, h/d = 1.2)
  Lattice(int dim, int side)
  {
    const auto order = cell_order(dim, side);
    std::vector<int> index(order.size());
    for (std::size_t k = 0; k < order.size(); k++) index[order[k]] = static_cast<int>(k);
    for (const int point : order) {
      add_neighbours(dim, side, point, index);
      ptr.push_back(static_cast<int>(col.size()));
    }
  }

 private:
  static constexpr int CELL = 3, REACH = 2;

  static std::vector<int> cell_order(int dim, int side)
  {
    std::vector<int> order;
    const int cells = (side + CELL - 1) / CELL, layers = dim == 3 ? cells : 1;
    for (int c = 0; c < cells * cells * layers; c++) {
      const int low[3] = {CELL * (c % cells), CELL * (c / cells % cells),
                          CELL * (c / cells / cells)};
      for (int k = low[2]; k < (dim == 3 ? std::min(low[2] + CELL, side) : 1); k++)
        for (int j = low[1]; j < std::min(low[1] + CELL, side); j++)
          for (int i = low[0]; i < std::min(low[0] + CELL, side); i++)
            order.push_back(i + side * (j + side * k));
    }
    return order;
  }

  void add_neighbours(int dim, int side, int point, const std::vector<int> &index)
  {
    const int x = point % side, y = point / side % side, z = point / side / side;
    const int depth = dim == 3 ? REACH : 0, height = dim == 3 ? side : 1;
    for (int k = -depth; k <= depth; k++)
      for (int j = -REACH; j <= REACH; j++)
        for (int i = -REACH; i <= REACH; i++) {
          const int square = i * i + j * j + k * k;
          const bool inside = x + i >= 0 && x + i < side && y + j >= 0 && y + j < side &&
              z + k >= 0 && z + k < height;
          if (square > 0 && square < 2.4 * 2.4 && inside)
            col.push_back(index[x + i + side * (y + j + side * (z + k))]);
        }
  }
};

void product(int dim, int side)
{
  const Lattice lattice(dim, side);
  const int n = static_cast<int>(lattice.ptr.size()) - 1;
  CsrMatrix A;
  A.reset(n, lattice.ptr.data(), lattice.col.data());
  for (int k = 0; k < lattice.ptr[n]; k++) A.val(k) = -1.0 / 32.0;
  for (int i = 0; i < n; i++) A.diag(i) = -A.row_sum(i);
  Vector x(n, 1.0), y(n);
  const double rows = n, entries = lattice.ptr[n];
  report("spmv", dim, rows, entries, 12.0 * entries + (4.0 + 3.0 * 8.0) * rows,
         [&] { A.multiply(x.data(), y.data()); });
}

}    // namespace

int main(int narg, char **arg)
{
  const double share = narg > 1 ? std::atof(arg[1]) : 1.0;    // of the usual sizes, to try it out
  const auto n = static_cast<std::size_t>(share * (1 << 24));
  stream(n);
  vector_loops(n / 4);
  product(2, static_cast<int>(1000 * std::sqrt(share)));
  product(3, static_cast<int>(75 * std::cbrt(share)));
  return 0;
}
