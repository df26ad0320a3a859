// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace vegetation_sim::canopy {

/// Columns transformed side by side; their data fit the first-level cache at 64 rows.
constexpr int BLOCK = 16;

/// One pass over a square of complex numbers, which transforms every column.
struct FourierPass {
  int size;
  const double *cosine, *sine;  // cosine and sine of -k turns / size
  const double *re, *im;        // input, row after row
  double *out_re, *out_im;      // output, in other memory
  bool transposed;              // the result is written transposed
  double* lanes;                // scratch of 4 * BLOCK * size
};

/// Transforms with the best available instruction set.
void transformColumns(const FourierPass& pass);

}  // namespace vegetation_sim::canopy
