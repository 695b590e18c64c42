// eval/simulation/texture/texture_settings.h: keys, ranges and meanings of texture settings.
#pragma once

#include "core/setting_rules.h"
#include "eval/simulation/texture/tissue_texture.h"
#include "eval/simulation/texture/vessel_growth.h"

namespace softscope {

template <class Visitor>
void describe(Visitor& v, VesselOptions& o) {
  v("texture.trunk_spacing_mm", o.trunk_spacing_mm, between(2, 200),
    "between neighbouring vessel trunks");
  v("texture.trunk_radius_mm", o.trunk_radius_mm, between(0, 3),
    "of the widest vessel; 0: no vessels");
}

template <class Visitor>
void describe(Visitor& v, TextureOptions& o) {
  v("texture.picture_mm", o.picture_mm, between(2, 2000), "width of the image on the tissue");
  v("texture.contrast", o.contrast, between(0, 2), "0: one colour, 1: healthy abdomen");
  v("texture.fat", o.fat, between(0, 1), "share of the surface under fat, roughly");
  v("texture.wetness", o.wetness, between(0, 5), "strength of specular highlights");
  v("texture.blood", o.blood, between(0, 1), "share of the surface under fresh blood, roughly");
  describe(v, o.vessels);
}

}  // namespace softscope
