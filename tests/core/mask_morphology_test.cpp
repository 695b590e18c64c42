#include "core/mask_morphology.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

namespace softscope {
namespace {

/// By the definition, pixel by pixel: any (or every) pixel within the radius is set.
Mask byDefinition(const Mask& mask, int radius_px, bool every) {
  Mask out(mask.width_px, mask.height_px, 0);
  for (int v = 0; v < mask.height_px; ++v)
    for (int u = 0; u < mask.width_px; ++u) {
      bool any_set = false, all_set = true;
      for (int y = 0; y < mask.height_px; ++y)
        for (int x = 0; x < mask.width_px; ++x)
          if (std::abs(x - u) <= radius_px && std::abs(y - v) <= radius_px) {
            any_set = any_set || mask.at(x, y) != 0;
            all_set = all_set && mask.at(x, y) != 0;
          }
      out.at(u, v) = every ? all_set : any_set;
    }
  return out;
}

TEST(MaskMorphology, DilatesAndErodesByTheDefinitionAlsoAtTheBorder) {
  std::mt19937 random(1);
  for (const int radius_px : {0, 1, 3, 20}) {
    Mask sparse(17, 11, 0), dense(17, 11, 0);
    for (std::size_t i = 0; i < sparse.values.size(); ++i) {
      sparse.values[i] = random() % 30 == 0 ? 255 : 0;  // any value but 0 is set
      dense.values[i] = random() % 30 == 0 ? 0 : 7;
    }
    for (const Mask& mask : {sparse, dense}) {
      EXPECT_EQ(dilated(mask, radius_px).values, byDefinition(mask, radius_px, false).values);
      EXPECT_EQ(eroded(mask, radius_px).values, byDefinition(mask, radius_px, true).values);
    }
  }
}

TEST(MaskMorphology, LeavesAnEmptyMaskEmpty) {
  EXPECT_TRUE(dilated({}, 3).empty());
  EXPECT_TRUE(eroded({}, 3).empty());
}

}  // namespace
}  // namespace softscope
