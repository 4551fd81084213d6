#pragma once

#include "engine/core/byte_stream.h"
#include "modules/diffraction/asset/representation.h"
#include "modules/diffraction/model/colour_kernel.h"

namespace rowland::diffraction {

BakedTables bake_tables(const Grating& grating, const Representation& representation);

/// The representation's number, then its tables.
void write_tables(const BakedTables& tables, ByteWriter& writer);
/// Throws Error (input) if the bytes are not such tables, or those of another representation than `expected`.
BakedTables read_tables(ByteReader& reader, const Representation& expected);

void write_kernel(const KernelTable& kernel, ByteWriter& writer);
/// Throws Error (input) if the bytes are not a kernel.
KernelTable read_kernel(ByteReader& reader);

}  // namespace rowland::diffraction
