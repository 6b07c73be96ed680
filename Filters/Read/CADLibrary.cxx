#include "CADLibrary.h"

#include <vtksys/DynamicLoader.hxx>
#include <vtksys/SystemTools.hxx>

#include <dlfcn.h>

namespace nurbs
{
namespace
{
struct LoadedReaders
{
  const CADReaders* Readers = nullptr;
  std::string Error;
};

/// It lies beside the library that this code is in.
std::string LibraryPath()
{
  Dl_info own{};
  dladdr(reinterpret_cast<const void*>(&LoadCADReaders), &own);
  const std::string path = own.dli_fname ? own.dli_fname : "";
  return vtksys::SystemTools::GetFilenamePath(path) + "/" + NURBSTRIM_CAD_LIBRARY;
}

LoadedReaders Load()
{
  LoadedReaders loaded;
  const auto library = vtksys::DynamicLoader::OpenLibrary(LibraryPath());
  const auto get = reinterpret_cast<decltype(&NURBSTrimGetCADReaders)>(
    library ? vtksys::DynamicLoader::GetSymbolAddress(library, "NURBSTrimGetCADReaders") : nullptr);
  if (get)
  {
    loaded.Readers = get();
  }
  else
  {
    const char* reason = vtksys::DynamicLoader::LastError();
    loaded.Error = reason ? reason : "it cannot be loaded";
  }
  return loaded;
}
}

//------------------------------------------------------------------------------
const CADReaders* LoadCADReaders(std::string& error)
{
  static const LoadedReaders loaded = Load();
  error = loaded.Error;
  return loaded.Readers;
}
}
