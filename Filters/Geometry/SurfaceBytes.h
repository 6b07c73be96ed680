/**
 * @file SurfaceBytes.h
 * @brief A surface as bytes, for another process.
 */
#ifndef SurfaceBytes_h
#define SurfaceBytes_h

#include "ByteStream.h"
#include "NurbsSurface.h"

namespace nurbs
{

void PackSurface(Packer& packer, const NurbsSurface& surface);

/// Where the bytes make no sense unpacker.Good is false afterwards; the surface is not checked.
NurbsSurface UnpackSurface(Unpacker& unpacker);

}

#endif
