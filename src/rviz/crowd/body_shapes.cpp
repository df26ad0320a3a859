// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/crowd/body_shapes.h"

#include <algorithm>

namespace vegetation_sim::view {

// Two rings with a small distance make a sharp edge of two colours.
const FormRings& trunkRings() {
  static const FormRings RINGS = {{-0.062, 0.022, 0.030, -0.002, Cover::TROUSERS, true},
                                  {-0.042, 0.074, 0.058, -0.005, Cover::TROUSERS, true},
                                  {-0.019, 0.092, 0.068, -0.006, Cover::UNDER_HEM, false},
                                  {-0.016, 0.0965, 0.073, -0.006, Cover::HEM, false, 0.92},
                                  {0.006, 0.096, 0.071, -0.006, Cover::HEM, true},
                                  {0.032, 0.090, 0.064, -0.003, Cover::HEM, true, 0.95},
                                  {0.035, 0.090, 0.064, -0.003, Cover::BELT, true},
                                  {0.049, 0.087, 0.061, -0.001, Cover::BELT, true},
                                  {0.053, 0.0875, 0.0615, -0.001, Cover::SHIRT, true, 0.84},
                                  {0.078, 0.0845, 0.059, 0.002, Cover::STRIPE, true, 1.04},
                                  {0.108, 0.083, 0.058, 0.004, Cover::SHIRT, false, 0.93},
                                  {0.150, 0.088, 0.061, 0.007, Cover::STRIPE, true, 1.03},
                                  {0.195, 0.095, 0.066, 0.008, Cover::SHIRT, true},
                                  {0.230, 0.102, 0.066, 0.004, Cover::STRIPE, true},
                                  {0.257, 0.133, 0.054, -0.002, Cover::YOKE},
                                  {0.285, 0.110, 0.043, -0.006, Cover::YOKE, true},
                                  {0.303, 0.076, 0.039, -0.009, Cover::YOKE},
                                  {0.312, 0.049, 0.036, -0.010, Cover::COLLAR, true, 0.95},
                                  {0.323, 0.036, 0.035, -0.008, Cover::COLLAR},
                                  {0.329, 0.0295, 0.031, -0.007, Cover::SKIN, false, 0.75},
                                  {0.372, 0.0285, 0.033, -0.002, Cover::SKIN, false, 0.9}};
  return RINGS;
}

const FormRings& headRings() {
  static const FormRings RINGS = {{-0.0060, 0.0130, 0.0170, 0.0280, Cover::SKIN, true, 0.8},
                                  {0.0020, 0.0235, 0.0290, 0.0225, Cover::SKIN, true, 0.95},
                                  {0.0100, 0.0291, 0.0386, 0.0153, Cover::SKIN},
                                  {0.0185, 0.0330, 0.0450, 0.0101, Cover::SKIN, true},
                                  {0.0240, 0.0352, 0.0482, 0.0073, Cover::SKIN, true},
                                  {0.0270, 0.0361, 0.0493, 0.0062, Cover::SKIN, true},
                                  {0.0302, 0.0370, 0.0506, 0.0049, Cover::SKIN, true},
                                  {0.0385, 0.0392, 0.0539, 0.0021, Cover::SKIN, true},
                                  {0.0465, 0.0404, 0.0554, 0.0003, Cover::SKIN, true},
                                  {0.0545, 0.0417, 0.0566, -0.0017, Cover::SKIN, true},
                                  {0.0625, 0.0425, 0.0570, -0.0025, Cover::SKIN, true},
                                  {0.0725, 0.0431, 0.0576, -0.0030, Cover::SKIN, true},
                                  {0.0765, 0.0435, 0.0580, -0.0030, Cover::SKIN, true},
                                  {0.0805, 0.0435, 0.0580, -0.0033, Cover::SKIN, true},
                                  {0.0960, 0.0430, 0.0570, -0.0045, Cover::SKIN},
                                  {0.1120, 0.0370, 0.0490, -0.0060, Cover::SKIN, true},
                                  {0.1260, 0.0220, 0.0300, -0.0060, Cover::SKIN, true},
                                  {0.1310, 0.0060, 0.0080, -0.0060, Cover::SKIN, true}};
  return RINGS;
}

const FormRings& armRings(bool bare) {
  // A short sleeve ends in a hem around the arm, a long one in a cuff around the wrist. The inner
  // ring of a hem is dark.
  static const FormRings BARE = {{-0.008, 0.004, 0.005, 0.0, Cover::YOKE, true},
                                 {0.000, 0.0115, 0.0160, 0.0, Cover::YOKE},
                                 {0.022, 0.0205, 0.0250, 0.0, Cover::YOKE, true},
                                 {0.045, 0.0250, 0.0285, 0.0, Cover::SHIRT, true},
                                 {0.117, 0.0250, 0.0285, 0.0, Cover::SHIRT, false, 0.95},
                                 {0.1185, 0.0240, 0.0275, 0.0, Cover::SHIRT, true, 0.55},
                                 {0.1190, 0.0208, 0.0240, 0.0, Cover::SKIN, true, 0.7},
                                 {0.172, 0.0190, 0.0222, 0.0, Cover::SKIN, true, 0.92},
                                 {0.200, 0.0198, 0.0230, 0.0, Cover::SKIN, true},
                                 {0.255, 0.0165, 0.0195, 0.0, Cover::SKIN},
                                 {0.311, 0.0115, 0.0158, 0.0, Cover::SKIN, true, 0.97},
                                 {0.335, 0.0105, 0.0185, 0.002, Cover::SKIN, true},
                                 {0.357, 0.0100, 0.0222, 0.002, Cover::SKIN},
                                 {0.366, 0.0088, 0.0216, 0.000, Cover::SKIN, true},
                                 {0.388, 0.0018, 0.0185, 0.000, Cover::SKIN, true, 0.8},
                                 {0.404, 0.0010, 0.0150, 0.000, Cover::SKIN, false, 0.8}};
  static const FormRings LONG = {{-0.008, 0.004, 0.005, 0.0, Cover::YOKE, true},
                                 {0.000, 0.0115, 0.0160, 0.0, Cover::YOKE},
                                 {0.022, 0.0205, 0.0250, 0.0, Cover::YOKE, true},
                                 {0.045, 0.0250, 0.0285, 0.0, Cover::SHIRT, true},
                                 {0.117, 0.0232, 0.0265, 0.0, Cover::SHIRT, false, 0.97},
                                 {0.172, 0.0208, 0.0242, 0.0, Cover::SHIRT, true, 0.86},
                                 {0.200, 0.0212, 0.0244, 0.0, Cover::SHIRT, true, 1.03},
                                 {0.255, 0.0184, 0.0212, 0.0, Cover::SHIRT},
                                 {0.303, 0.0152, 0.0185, 0.0, Cover::CUFF, true},
                                 {0.3175, 0.0150, 0.0185, 0.0, Cover::CUFF, true, 0.9},
                                 {0.3185, 0.0113, 0.0158, 0.0, Cover::SKIN, true, 0.65},
                                 {0.335, 0.0105, 0.0185, 0.002, Cover::SKIN, true},
                                 {0.357, 0.0100, 0.0222, 0.002, Cover::SKIN},
                                 {0.366, 0.0088, 0.0216, 0.000, Cover::SKIN, true},
                                 {0.388, 0.0018, 0.0185, 0.000, Cover::SKIN, true, 0.8},
                                 {0.404, 0.0010, 0.0150, 0.000, Cover::SKIN, false, 0.8}};
  return bare ? BARE : LONG;
}

const FormRings& legRings(bool bare) {
  static const FormRings TROUSERS = {{-0.004, 0.031, 0.040, -0.005, Cover::TROUSERS},
                                     {0.040, 0.0475, 0.056, -0.004, Cover::TROUSERS, true, 0.93},
                                     {0.080, 0.0470, 0.054, -0.002, Cover::TROUSERS, true},
                                     {0.135, 0.0435, 0.050, 0.002, Cover::TROUSERS},
                                     {0.205, 0.0380, 0.044, 0.003, Cover::TROUSERS, true},
                                     {0.245, 0.0365, 0.0425, 0.004, Cover::TROUSERS, false, 0.9},
                                     {0.285, 0.0350, 0.041, -0.001, Cover::TROUSERS, true, 0.97},
                                     {0.330, 0.0340, 0.041, -0.006, Cover::TROUSERS},
                                     {0.415, 0.0310, 0.036, -0.004, Cover::TROUSERS, true},
                                     {0.452, 0.0300, 0.035, 0.000, Cover::TROUSERS, false, 0.86},
                                     {0.474, 0.0320, 0.039, 0.003, Cover::TROUSERS, true}};
  static const FormRings BARE = {{-0.004, 0.031, 0.040, -0.005, Cover::TROUSERS},
                                 {0.040, 0.0475, 0.056, -0.004, Cover::TROUSERS, true, 0.93},
                                 {0.135, 0.0445, 0.051, 0.002, Cover::TROUSERS},
                                 {0.211, 0.0430, 0.0485, 0.002, Cover::TROUSERS, true, 0.96},
                                 {0.214, 0.0340, 0.0400, 0.003, Cover::SHANK, true, 0.7},
                                 {0.245, 0.0305, 0.0365, 0.004, Cover::SHANK, false, 0.95},
                                 {0.285, 0.0285, 0.0340, -0.002, Cover::SHANK, true},
                                 {0.325, 0.0295, 0.0375, -0.010, Cover::SHANK},
                                 {0.400, 0.0215, 0.0260, -0.004, Cover::SHANK, true},
                                 {0.448, 0.0185, 0.0225, 0.000, Cover::SHANK},
                                 {0.474, 0.0195, 0.0245, 0.002, Cover::SOCKS, true, 0.9}};
  return bare ? BARE : TROUSERS;
}

const FormRings& shoeRings() {
  static const FormRings RINGS = {{-0.018, 0.004, 0.006, 0.000, Cover::SHOES, true, 0.9},
                                  {-0.010, 0.020, 0.022, 0.004, Cover::SHOES},
                                  {0.012, 0.0235, 0.030, 0.012, Cover::SHOES, true},
                                  {0.040, 0.0250, 0.033, 0.015, Cover::SHOES},
                                  {0.075, 0.0270, 0.022, 0.004, Cover::SHOES, true},
                                  {0.105, 0.0285, 0.017, -0.001, Cover::SHOES},
                                  {0.127, 0.0215, 0.012, -0.006, Cover::SHOES, true},
                                  {0.140, 0.0050, 0.004, -0.012, Cover::SHOES, true}};
  return RINGS;
}

// From the skin around it over the lids to the white.
const FormRings& eyeRings() {
  static const FormRings RINGS = {{-0.0012, 0.0130, 0.0085, 0.0, Cover::SKIN, true, 0.92},
                                  {0.0006, 0.0106, 0.0050, 0.0, Cover::SKIN, true, 0.92},
                                  {0.0012, 0.0094, 0.0034, 0.0, Cover::LASHES, true},
                                  {0.0006, 0.0088, 0.0027, 0.0, Cover::EYE, true, 0.85},
                                  {0.0017, 0.0001, 0.0001, 0.0, Cover::EYE, true}};
  return RINGS;
}

const FormRings& irisRings() {
  static const FormRings RINGS = {{0.0018, 0.0033, 0.0028, 0.0, Cover::IRIS, true},
                                  {0.0023, 0.0001, 0.0001, 0.0, Cover::IRIS, true, 0.15}};
  return RINGS;
}

const FormRings& earRings() {
  static const FormRings RINGS = {{-0.0030, 0.0070, 0.0140, 0.0, Cover::SKIN, true, 0.8},
                                  {0.0055, 0.0085, 0.0160, 0.0, Cover::SKIN, true},
                                  {0.0030, 0.0001, 0.0001, 0.0, Cover::SKIN, true, 0.55}};
  return RINGS;
}

double curlOf(double beyond) {
  constexpr double BENT = 5.5;
  return BENT * beyond * std::max(0.0, beyond);
}

FormRings fingerRings(double length, double radius) {
  FormRings out = {{-0.010, 0.8 * radius, 0.8 * radius},
                   {0.30 * length, radius, radius},
                   {0.80 * length, 0.9 * radius, 0.9 * radius},
                   {length, 0.25 * radius, 0.25 * radius, 0.0, Cover::SKIN, false, 1.04}};
  for (FormRing& ring : out) ring.forward = curlOf(ring.along);
  return out;
}

const FormRings& skirtRings(bool coat) {
  static const FormRings SKIRT = {{-0.215, 0.116, 0.096, 0.000, Cover::SKIRT, true, 0.9},
                                  {-0.135, 0.112, 0.092, -0.002, Cover::SKIRT, true},
                                  {-0.060, 0.107, 0.086, -0.004, Cover::SKIRT, true},
                                  {-0.010, 0.1030, 0.078, -0.006, Cover::SKIRT, true},
                                  {0.036, 0.0890, 0.0630, -0.003, Cover::SKIRT, true, 0.9}};
  static const FormRings COAT = {{-0.170, 0.114, 0.093, 0.000, Cover::SKIRT, true, 0.9},
                                 {-0.110, 0.112, 0.091, -0.002, Cover::SKIRT, true},
                                 {-0.050, 0.108, 0.086, -0.004, Cover::SKIRT, true},
                                 {0.000, 0.1020, 0.0775, -0.006, Cover::SKIRT, true},
                                 {0.060, 0.0860, 0.0602, -0.001, Cover::SKIRT, true, 0.9}};
  return coat ? COAT : SKIRT;
}

}  // namespace vegetation_sim::view
