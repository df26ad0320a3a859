// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/crowd/body_shapes.h"

namespace vegetation_sim::view {

// Two rings with a small distance make a sharp edge of two colours.
const FormRings& trunkRings() {
  static const FormRings RINGS = {{-0.062, 0.022, 0.030, -0.002, Cover::TROUSERS, true},
                                  {-0.042, 0.074, 0.058, -0.005, Cover::TROUSERS, true},
                                  {-0.019, 0.092, 0.068, -0.006, Cover::TROUSERS, false, 0.6},
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
                                  {0.260, 0.134, 0.054, -0.002, Cover::YOKE},
                                  {0.285, 0.111, 0.043, -0.006, Cover::YOKE, true},
                                  {0.303, 0.076, 0.039, -0.009, Cover::YOKE},
                                  {0.312, 0.049, 0.036, -0.010, Cover::COLLAR, true, 0.95},
                                  {0.323, 0.036, 0.035, -0.008, Cover::COLLAR},
                                  {0.329, 0.0295, 0.031, -0.007, Cover::SKIN, false, 0.75},
                                  {0.372, 0.0285, 0.033, -0.002, Cover::SKIN, false, 0.9}};
  return RINGS;
}

const FormRings& headRings() {
  static const FormRings RINGS = {{-0.006, 0.013, 0.017, 0.028, Cover::SKIN, true, 0.8},
                                  {0.002, 0.0235, 0.029, 0.0225, Cover::SKIN, true, 0.95},
                                  {0.012, 0.0305, 0.041, 0.0135, Cover::SKIN},
                                  {0.0235, 0.035, 0.048, 0.0075, Cover::SKIN, true},
                                  {0.0300, 0.037, 0.0505, 0.005, Cover::SKIN, true},
                                  {0.0365, 0.0385, 0.053, 0.003, Cover::SKIN, true},
                                  {0.044, 0.040, 0.055, 0.001, Cover::SKIN, true},
                                  {0.053, 0.0415, 0.0565, -0.0015, Cover::SKIN, true},
                                  {0.0625, 0.0425, 0.057, -0.0025, Cover::SKIN, true},
                                  {0.071, 0.043, 0.0575, -0.003, Cover::SKIN, true},
                                  {0.0765, 0.0435, 0.058, -0.003, Cover::SKIN, true},
                                  {0.083, 0.0435, 0.058, -0.0035, Cover::SKIN, true},
                                  {0.096, 0.043, 0.057, -0.0045, Cover::SKIN},
                                  {0.112, 0.037, 0.049, -0.006, Cover::SKIN, true},
                                  {0.126, 0.022, 0.030, -0.006, Cover::SKIN, true},
                                  {0.131, 0.006, 0.008, -0.006, Cover::SKIN, true}};
  return RINGS;
}

const FormRings& armRings() {
  static const FormRings RINGS = {{-0.008, 0.004, 0.005, 0.0, Cover::YOKE, true},
                                  {0.000, 0.0165, 0.0195, 0.0, Cover::YOKE},
                                  {0.014, 0.0235, 0.0265, 0.0, Cover::YOKE, true},
                                  {0.045, 0.0250, 0.0285, 0.0, Cover::SHIRT, true},
                                  {0.118, 0.0245, 0.0275, 0.0, Cover::SHIRT, false, 0.95},
                                  {0.123, 0.0215, 0.0245, 0.0, Cover::SLEEVE, false, 0.9},
                                  {0.172, 0.0205, 0.0240, 0.0, Cover::SLEEVE, true, 0.84},
                                  {0.200, 0.0210, 0.0240, 0.0, Cover::SLEEVE, true, 1.03},
                                  {0.255, 0.0180, 0.0205, 0.0, Cover::SLEEVE},
                                  {0.311, 0.0155, 0.0175, 0.0, Cover::CUFF, true},
                                  {0.316, 0.0120, 0.0150, 0.0, Cover::SKIN, true, 0.85},
                                  {0.335, 0.0120, 0.0185, 0.002, Cover::SKIN, true},
                                  {0.357, 0.0125, 0.0215, 0.003, Cover::SKIN},
                                  {0.372, 0.0120, 0.0200, 0.001, Cover::SKIN, true, 0.93},
                                  {0.410, 0.0095, 0.0170, 0.000, Cover::SKIN, true, 0.92},
                                  {0.425, 0.0040, 0.0090, 0.000, Cover::SKIN, false, 0.8}};
  return RINGS;
}

const FormRings& legRings(bool bare) {
  static const FormRings TROUSERS = {{-0.030, 0.020, 0.024, -0.004, Cover::TROUSERS, true},
                                     {0.000, 0.038, 0.048, -0.005, Cover::TROUSERS},
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
  static const FormRings BARE = {{-0.030, 0.020, 0.024, -0.004, Cover::TROUSERS, true},
                                 {0.000, 0.038, 0.048, -0.005, Cover::TROUSERS},
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

const FormRings& eyeRings() {
  static const FormRings RINGS = {{0.0000, 0.0080, 0.0040, 0.0, Cover::EYE, true, 0.9},
                                  {0.0010, 0.0031, 0.0034, 0.0, Cover::IRIS, true},
                                  {0.0012, 0.0004, 0.0004, 0.0, Cover::IRIS, true, 0.5}};
  return RINGS;
}

const FormRings& skirtRings(bool coat) {
  static const FormRings SKIRT = {{-0.215, 0.116, 0.096, 0.000, Cover::SKIRT, true, 0.9},
                                  {-0.135, 0.112, 0.092, -0.002, Cover::SKIRT, true},
                                  {-0.060, 0.107, 0.086, -0.004, Cover::SKIRT, true},
                                  {-0.010, 0.1030, 0.078, -0.006, Cover::SKIRT, true},
                                  {0.030, 0.0935, 0.0670, -0.003, Cover::SKIRT, true, 0.9}};
  static const FormRings COAT = {{-0.170, 0.114, 0.093, 0.000, Cover::SKIRT, true, 0.9},
                                 {-0.110, 0.112, 0.091, -0.002, Cover::SKIRT, true},
                                 {-0.050, 0.108, 0.086, -0.004, Cover::SKIRT, true},
                                 {0.000, 0.1020, 0.0775, -0.006, Cover::SKIRT, true},
                                 {0.060, 0.0890, 0.0630, -0.001, Cover::SKIRT, true, 0.9}};
  return coat ? COAT : SKIRT;
}

}  // namespace vegetation_sim::view
