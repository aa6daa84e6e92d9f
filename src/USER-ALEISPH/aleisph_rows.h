// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The one way to run over particles. A function of the local index i is called
   for each row of a list; an integer n in place of the list stands for the rows
   0 ... n-1.

     for_rows      f(i)
     sum_rows      the sum of f(i), in the order of the rows: the same to the last bit every
                   time. Several sums at once: a struct with operator+=.
     count_rows    of how many rows f(i) is true
     max_rows      the largest of f(i), and `least` if none is larger
     min_rows      the smallest of f(i), and `most` if none is smaller
     select_rows   the rows of which f(i) is true, in their order
     sum_blocks    as sum_rows, over WIDTH rows at a time (the last ones may be fewer):
                   the sum of f(rows, n), for what is computed for many rows together

   Today these are loops. So that they can be shared among threads or be given to a
   device without a change of f:
   - What f writes belongs to row i, and no f reads what the f of another row writes:
     rows may be run in any order or at the same time. Whatever needs results of other rows
     comes in a second call.
   - No counter or sum is captured by reference: f returns the part of row i.
   - Where f needs memory to work in (Images, a list of normals), the object that has it is
     captured by reference and says nothing after f: such an object is one per thread.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_ROWS_H
#define LMP_ALEISPH_ROWS_H

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace aleisph {

using Rows = std::vector<int>;    // owned particles, by local index

template <class F> inline void for_rows(const Rows &rows, F &&f)
{
  for (const int i : rows) f(i);
}

template <class F> inline void for_rows(int n, F &&f)
{
  for (int i = 0; i < n; i++) f(i);
}

// Sums start from zero, as T{}.
template <class List, class F> inline auto sum_rows(const List &rows, F &&f)
{
  using T = std::decay_t<decltype(f(0))>;
  static_assert(!std::is_same_v<T, bool>, "a sum of bool is no number: use count_rows");
  T sum{};
  for_rows(rows, [&sum, &f](int i) { sum += f(i); });
  return sum;
}

template <class List, class F> inline int count_rows(const List &rows, F &&f)
{
  return sum_rows(rows, [&f](int i) { return f(i) ? 1 : 0; });
}

template <class List, class F, class T> inline T max_rows(const List &rows, F &&f, T least)
{
  for_rows(rows, [&least, &f](int i) { least = std::max(least, static_cast<T>(f(i))); });
  return least;
}

template <class List, class F, class T> inline T min_rows(const List &rows, F &&f, T most)
{
  for_rows(rows, [&most, &f](int i) { most = std::min(most, static_cast<T>(f(i))); });
  return most;
}

template <class List, class F> inline Rows select_rows(const List &rows, F &&f)
{
  Rows selected;
  for_rows(rows, [&selected, &f](int i) {
    if (f(i)) selected.push_back(i);
  });
  return selected;
}

template <int WIDTH, class F> inline auto sum_blocks(const Rows &rows, F &&f)
{
  std::decay_t<decltype(f(rows.data(), 0))> sum{};
  for (std::size_t first = 0; first < rows.size(); first += WIDTH)
    sum += f(rows.data() + first,
             static_cast<int>(std::min<std::size_t>(WIDTH, rows.size() - first)));
  return sum;
}

template <int WIDTH, class F> inline auto sum_blocks(int n, F &&f)
{
  int rows[WIDTH];
  std::decay_t<decltype(f(rows, 0))> sum{};
  for (int first = 0; first < n; first += WIDTH) {
    const int count = std::min(WIDTH, n - first);
    for (int k = 0; k < count; k++) rows[k] = first + k;
    sum += f(static_cast<const int *>(rows), count);
  }
  return sum;
}

}    // namespace aleisph
#endif
