#include "colour_scale.h"

#include <vtkColorTransferFunction.h>
#include <vtkNew.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lorica::viewport {

namespace {

using document::Colouring;

constexpr std::array<double, 3> inside{0.82, 0.82, 0.82};

/// viridis (van der Walt and Smith 2015, CC0) at nine even places, shallow to deep.
constexpr std::array<std::array<double, 3>, 9> viridis{{{0.993, 0.906, 0.144},
                                                        {0.678, 0.864, 0.190},
                                                        {0.361, 0.786, 0.388},
                                                        {0.153, 0.678, 0.506},
                                                        {0.128, 0.567, 0.551},
                                                        {0.173, 0.449, 0.558},
                                                        {0.230, 0.322, 0.546},
                                                        {0.279, 0.175, 0.483},
                                                        {0.267, 0.005, 0.329}}};

vtkColorTransferFunction* strainColours() {
  static const vtkNew<vtkColorTransferFunction> colours = [] {
    vtkNew<vtkColorTransferFunction> made;
    made->SetColorSpaceToDiverging();
    made->AddRGBPoint(-1.0, 0.230, 0.299, 0.754);
    made->AddRGBPoint(1.0, 0.706, 0.016, 0.150);
    return made;
  }();
  return colours;
}

vtkColorTransferFunction* depthColours() {
  static const vtkNew<vtkColorTransferFunction> colours = [] {
    vtkNew<vtkColorTransferFunction> made;
    made->SetColorSpaceToLab();
    for (std::size_t i = 0; i < viridis.size(); ++i) {
      made->AddRGBPoint(static_cast<double>(i) / (viridis.size() - 1), viridis[i][0], viridis[i][1], viridis[i][2]);
    }
    return made;
  }();
  return colours;
}

double niceAbove(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0}) {
    if (value <= step * decade * (1.0 + 1e-6)) {
      return step * decade;
    }
  }
  return 10.0 * decade;
}

}  // namespace

QColor ColourScale::at(double value) const {
  std::array<double, 3> rgb = inside;
  const double share = value / end;
  if (what == Colouring::strain) {
    strainColours()->GetColor(std::clamp(share, -1.0, 1.0), rgb.data());
  } else if (value > 0.0) {
    depthColours()->GetColor(std::min(share, 1.0), rgb.data());
  }
  return QColor::fromRgbF(static_cast<float>(rgb[0]), static_cast<float>(rgb[1]), static_cast<float>(rgb[2]));
}

ColourScale scaleFor(Colouring what, std::span<const std::span<const float>> values) {
  std::vector<float> sizes;
  for (const std::span<const float> some : values) {
    for (const float value : some) {
      if (value != 0.0F) {
        sizes.push_back(std::abs(value));
      }
    }
  }
  double end = what == Colouring::strain ? 0.05 : 1e-3;
  if (!sizes.empty()) {
    const auto most = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() * 99 / 100);
    std::nth_element(sizes.begin(), most, sizes.end());
    end = std::max(end, niceAbove(*most));
  }
  return {what, end};
}

}  // namespace lorica::viewport
