#include "SurfaceBytes.h"

namespace nurbs
{

void PackSurface(Packer& packer, const NurbsSurface& surface)
{
  for (const int value : { surface.DegreeU, surface.DegreeV, surface.CountU, surface.CountV })
  {
    packer.Put(value);
  }
  packer.PutAll(surface.KnotsU);
  packer.PutAll(surface.KnotsV);
  packer.PutAll(surface.ControlPoints);
  packer.Put<std::uint64_t>(surface.TrimLoops.size());
  for (const std::vector<Vec2>& loop : surface.TrimLoops)
  {
    packer.PutAll(loop);
  }
  packer.Put(surface.Tolerance);
}

NurbsSurface UnpackSurface(Unpacker& unpacker)
{
  NurbsSurface surface;
  for (int* value : { &surface.DegreeU, &surface.DegreeV, &surface.CountU, &surface.CountV })
  {
    *value = unpacker.Take<int>();
  }
  unpacker.TakeAll(surface.KnotsU);
  unpacker.TakeAll(surface.KnotsV);
  unpacker.TakeAll(surface.ControlPoints);
  surface.TrimLoops.resize(unpacker.TakeCount(8));
  for (std::vector<Vec2>& loop : surface.TrimLoops)
  {
    unpacker.TakeAll(loop);
  }
  surface.Tolerance = unpacker.Take<double>();
  return surface;
}

}
