// Samples of every lobe against its density by chi-square, and their weights against the albedo:
// expectations by adaptive quadrature of the double twin's evaluation (accuracy.md section 4).
#include <gtest/gtest.h>

#include <numeric>

#include "support/bsdf_cases.h"
#include "support/double_twin.h"
#include "support/statistics.h"
#include "support/test_scenes.h"
#include "support/twin_bsdf.h"

namespace {

using namespace twin;
using namespace pellucid::test;

/// Per case; the pooled cells then see an error of 1 % in any 1 % of the lobe. The double build
/// repeats only the formulas, so it may look less hard.
constexpr int samples = is_float ? 400000 : 200000;
/// Absolute error of the integral over a cell; 640 such errors are 4 samples of all.
constexpr double cell_tolerance = 1e-8;
/// What all cells along a horizon, where densities jump, may add up to.
constexpr double horizon_error = 2e-4;

struct Side {
  LobeGrid grid;
  double sign;  // of wi.z
  std::vector<double> expected, albedo;
};

/// Cells of both hemispheres with the probability of a sample and the reflected power in each.
std::vector<Side> sides_of(const BsdfCase& c) {
  std::vector<Side> sides;
  const auto add = [&](const LobeShape& shape, double sign) {
    Side side{LobeGrid(shape.axis, shape.width, 20, 16), sign, {}, {}};
    const auto integrate = [&](auto value, double tolerance) {
      return side.grid.integrate_cells(
          [&](const glm::dvec3& w) {
            if (w.z * sign <= 0) return 0.0;
            return value(reference_bsdf(c, w), w);
          },
          tolerance);
    };
    side.expected =
        integrate([](const ReferenceBsdf& e, const glm::dvec3&) { return e.pdf; }, cell_tolerance);
    side.albedo =
        integrate([](const ReferenceBsdf& e, const glm::dvec3& w) { return e.f.x * std::abs(w.z); },
                  10 * cell_tolerance);
    sides.push_back(std::move(side));
  };
  add(reflection_shape(c), 1.0);
  if (bsdf_is_transmissive(c.material)) add(transmission_shape(c), -1.0);
  return sides;
}

double total(const std::vector<Side>& sides, std::vector<double> Side::*what) {
  double sum = 0;
  for (const Side& s : sides) sum += std::accumulate((s.*what).begin(), (s.*what).end(), 0.0);
  return sum;
}

/// Directions narrower than float can tell apart: cells would measure rounding, not the sampler.
bool resolvable(const BsdfCase& c) {
  return !is_float || c.material.kind != MATERIAL_ROUGH_DIELECTRIC ||
         std::abs(c.eta - 1) * c.material.alpha > 1000 * double(UNIT_ROUNDOFF);
}

struct Drawn {
  ChiSquare directions;
  Moments weight, delta_weight;
};

Drawn draw_many(const BsdfCase& c, const std::vector<Side>& sides, unsigned seed) {
  Random random(seed);
  std::vector<std::vector<double>> count;
  for (const Side& s : sides) count.emplace_back(s.expected.size(), 0.0);
  double lost = 0, wrong_side = 0;
  Drawn drawn;
  for (int i = 0; i < samples; ++i) {
    const BsdfSample s = draw(c, 0, random);
    drawn.weight.add(s.delta ? 0.0 : double(s.weight.x));
    drawn.delta_weight.add(s.delta ? double(s.weight.x) : 0.0);
    if (s.pdf_w == 0) {
      ++lost;
      continue;
    }
    const size_t side = s.wi.z > 0 ? 0 : 1;
    if (side < sides.size())
      ++count[side][size_t(sides[side].grid.cell(to_dvec3(s.wi)))];
    else
      ++wrong_side;
  }
  std::vector<double> observed, expected;
  for (size_t side = 0; side < sides.size(); ++side) {
    observed.insert(observed.end(), count[side].begin(), count[side].end());
    for (double p : sides[side].expected) expected.push_back(p * samples);
  }
  // What scatters nowhere is one more cell.
  observed.push_back(lost);
  expected.push_back(std::max(0.0, 1 - total(sides, &Side::expected)) * samples);
  drawn.directions = chi_square(observed, expected);
  drawn.directions.in_empty_cells = wrong_side;
  return drawn;
}

TEST(TwinBsdf, SamplesFollowTheDensityAndWeighTheAlbedo) {
  const std::vector<BsdfCase> cases = density_cases();
  const double alpha = sidak(family_alpha, 3 * int(cases.size()));
  unsigned seed = 100;
  for (const BsdfCase& c : cases) {
    // Nearly matched indices at grazing angles: half of the light goes through within |eta - 1|^0.5
    // of the horizon, half through the critical facets; no cells of ours resolve both.
    if (std::abs(c.eta - 1.0) < 1e-3 && c.eta != 1.0 && c.wo.z < 0.1) continue;
    const std::vector<Side> sides = sides_of(c);
    // The density of what is scattered is at most 1.
    EXPECT_LT(total(sides, &Side::expected), 1 + horizon_error) << c.name;
    const Drawn drawn = draw_many(c, sides, ++seed);
    if (resolvable(c)) {
      EXPECT_TRUE(accepted(drawn.directions, alpha))
          << c.name << ": " << drawn.directions.describe();
    }
    const double albedo = total(sides, &Side::albedo);
    // Constant weights (no variance at all) still carry the rounding of float, over all cells.
    const double slack = horizon_error + 1e-4 * albedo * (is_float ? 1 : 0);
    EXPECT_GT(z_test(drawn.weight, albedo, slack), alpha)
        << c.name << ": mean weight " << drawn.weight.mean << " +- "
        << drawn.weight.standard_error() << ", albedo " << albedo;
    EXPECT_GT(z_test(drawn.delta_weight, c.delta_albedo, 1e-6), alpha)
        << c.name << ": mean delta weight " << drawn.delta_weight.mean << ", exact "
        << c.delta_albedo;
    const double most =
        c.material.kind == MATERIAL_ROUGH_DIELECTRIC ? std::max(1.0, 1 / (c.eta * c.eta)) : 1.0;
    EXPECT_LT(albedo + c.delta_albedo, most * (1 + horizon_error))
        << c.name << ": more light than there was";
  }
}

/// The furnace in both walks of rough glass: importance is never amplified, whatever the index.
TEST(TwinBsdf, FurnaceOfRoughGlass) {
  for (double ior : {1.5, 1 / 1.5, 2.4})
    for (double width : {0.05, 0.3, 1.0})
      for (double cosine : {1.0, 0.5, 0.05}) {
        const BsdfCase c{
            "", glass(ior, width), {std::sqrt(1 - cosine * cosine), 0, cosine}, ior, 1, {}, 0};
        Random random(9);
        Moments weight;
        for (int i = 0; i < 50000; ++i) weight.add(double(draw(c, 1, random).weight.x));
        EXPECT_LT(weight.mean, 1 + 1e-6);
        // Narrow lobes lose nothing to shadowing but at grazing angles.
        if (width == 0.05 && cosine == 1.0) {
          EXPECT_GT(weight.mean, 0.995) << ior;
        }
      }
}

}  // namespace
