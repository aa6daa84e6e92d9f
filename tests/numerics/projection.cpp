// SPDX-License-Identifier: GPL-2.0-only

#include "projection.h"

#include "aleisph_wall_contact.h"

#include "aleisph_surface.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace aleisph_test {

using namespace aleisph;

namespace {

double distance(const Point &p, const Point &q)
{
  return std::sqrt((p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]) +
                   (p[2] - q[2]) * (p[2] - q[2]));
}

bool near_fluid(const Scene &scene, const Point &x, double reach)
{
  for (size_t j = 0; j < scene.points.size(); j++)
    if ((scene.role[j] & FLUID) && distance(x, scene.points[j]) < reach) return true;
  return false;
}

// without the walls that are farther than 1.2 d from all fluid, times the root of the number of
// faces that meet there
Scene without_dry_walls(const Scene &scene)
{
  Scene wet;
  wet.dim = scene.dim;
  wet.d = scene.d;
  for (size_t i = 0; i < scene.points.size(); i++) {
    const double reach = 1.2 * scene.d * std::sqrt(scene.faces[i]);
    if ((scene.role[i] & WALL) && !near_fluid(scene, scene.points[i], reach)) continue;
    const double *n = &scene.normal[3 * i];
    wet.add(scene.points[i], scene.role[i], {n[0], n[1], n[2]}, scene.faces[i]);
  }
  return wet;
}

// height of the surface in spacings
double waves(const SplashParams &params, const std::array<double, 3> &phase, double i, double j)
{
  return params.height *
      (0.55 + 0.25 * std::sin(phase[0] + 0.9 * i) + 0.2 * std::sin(phase[1] + 2.1 * i) +
       0.2 * std::sin(phase[2] + 1.3 * j));
}

}    // namespace

Scene splash(int dim, const SplashParams &params, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> deviate(0.0, 1.0);
  Scene scene;
  scene.dim = dim;
  scene.d = D;
  const std::array<double, 3> phase = {6.3 * deviate(random), 6.3 * deviate(random),
                                       dim == 3 ? 6.3 * deviate(random) : 0.0};
  const int w = params.width, h = params.height;
  const int size[3] = {w + 2, dim == 3 ? w + 2 : h + 2, dim == 3 ? h + 2 : 0};
  for (int k = 0; k <= size[2]; k++)
    for (int j = 0; j <= size[1]; j++)
      for (int i = 0; i <= size[0]; i++) {
        const int index[3] = {i, j, k};
        Point x{}, n{};
        int faces = 0;
        for (int a = 0; a < dim; a++) {
          x[a] = index[a] * D;
          n[a] = index[a] == 0 ? 1.0 : 0.0;
          faces += index[a] == 0;
        }
        if (faces > 0 && params.walls) scene.add(x, WALL | SLIP, n, faces);
        if (faces > 0 || i > w || (dim == 3 && j > w)) continue;
        const bool spray = index[dim - 1] > waves(params, phase, i, dim == 3 ? j : 0);
        if (deviate(random) < (spray ? 0.85 : params.holes)) continue;
        for (int a = 0; a < dim; a++)
          x[a] = std::max(x[a] + params.jitter * D * (2.0 * deviate(random) - 1.0), 0.5 * D);
        if (!near_fluid(scene, x, 0.7 * D)) scene.add(x, FLUID);
      }
  return scene;
}

FreeSurfaceFlow::FreeSurfaceFlow(const Scene &scene) :
    scene_(without_dry_walls(scene)), cloud_(Discretized(scene_, LaplacianLimits(), false).cloud())
{
  cloud_.set_floor(FLOOR);
  detect_surface(cloud_, SurfaceParams());
}

std::vector<double> FreeSurfaceFlow::gradient(const double *p) const
{
  std::vector<double> grad(3 * static_cast<size_t>(size()), 0.0);
  aleisph::gradient(cloud_, fluid(), p, grad.data());
  return grad;
}

int FreeSurfaceFlow::correct_self_term(SelfTerm kind, const double *p,
                                       std::vector<double> &grad) const
{
  if (kind == SelfTerm::PUBLISHED) return 0;
  SelfTermParams params;
  params.bounded = kind == SelfTerm::BOUNDED;
  return aleisph::correct_self_term(cloud_, params, inverse(), p, grad.data());
}

namespace {

// -dt/rho0 times this is the change of velocity by the pressure p
std::vector<double> guarded_gradient(const FreeSurfaceFlow &flow, const Vector &p, SelfTerm kind)
{
  std::vector<double> grad = flow.gradient(p.data());
  flow.correct_self_term(kind, p.data(), grad);
  symmetric_gradient(flow.cloud(), flow.fluid(), FreeSurfaceFlow::SYMMETRIC, p.data(), grad.data());
  for (const int i : flow.fluid())
    if (flow.role()[i] & BALLISTIC) std::fill_n(&grad[3 * i], 3, 0.0);
  return grad;
}

}    // namespace

Eigen::MatrixXd projection(const FreeSurfaceFlow &flow, SelfTerm kind, double surface_offset)
{
  const double d = flow.scene().d;
  const int dim = flow.scene().dim, n = flow.size();
  PpeOptions options;
  options.surface_offset = surface_offset * d;
  options.min_wall_lambda = 0.2;
  options.min_wall_fluid = 2;
  CsrMatrix A;
  PpeLayout layout;
  assemble_ppe(flow.cloud(), weights(flow.l(), flow.s()), options, A, layout);
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(Eigen::MatrixXd(to_eigen(A)));

  const int m = static_cast<int>(flow.fluid().size()) * dim;
  const auto unknown = [&flow, dim](int c) { return 3 * flow.fluid()[c / dim] + c % dim; };
  const std::vector<double> zero(3 * static_cast<size_t>(n), 0.0);
  std::vector<double> v = zero, div(n, 0.0);
  Eigen::MatrixXd P = Eigen::MatrixXd::Identity(m, m);
  for (int c = 0; c < m; c++) {
    v[unknown(c)] = 1.0;
    std::vector<double> sliding = v;
    slide_with_fluid(flow.cloud(), slip_walls(flow.cloud()), sliding.data());
    divergence(flow.cloud(), flow.fluid(), sliding.data(), div.data());
    v[unknown(c)] = 0.0;
    Vector b(n);
    PpeFields fields;
    fields.rho_over_dt = 1.0;
    fields.vstar = fields.vwall = fields.p = zero.data();
    fields.div = div.data();
    ppe_rhs(flow.cloud(), layout, fields, b.data());
    const std::vector<double> grad = guarded_gradient(flow, lu.solve(b), kind);
    for (int r = 0; r < m; r++) P(r, c) -= grad[unknown(r)];
  }
  return P;
}

double spectral_radius(const Eigen::MatrixXd &P)
{
  return P.eigenvalues().cwiseAbs().maxCoeff();
}

}    // namespace aleisph_test
