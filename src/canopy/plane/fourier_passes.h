// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace vegetation_sim::canopy {

/// Columns that are transformed side by side: their work fits the first cache at 64 rows.
constexpr int BLOCK = 16;

/// One pass over a square of complex numbers: every column is transformed.
struct FourierPass {
  int size;
  const double *cosine, *sine;  // of -k turns / size
  const double *re, *im;        // in, row after row
  double *out_re, *out_im;      // out, another place
  bool transposed;              // whether the result is written with rows for columns
  double* lanes;                // scratch, 4 * BLOCK * size
};

/// Chooses the best instruction set that is here.
void transformColumns(const FourierPass& pass);

}  // namespace vegetation_sim::canopy
