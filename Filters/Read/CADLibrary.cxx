#include "CADLibrary.h"

#include <vtksys/SystemTools.hxx>

#include <dlfcn.h>

#include <algorithm>
#include <initializer_list>

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

/// Whether what all libraries here use by these names is what this library has.
bool Serves(const char* library, std::initializer_list<const char*> names)
{
  void* const loaded = dlopen(library, RTLD_LAZY | RTLD_NOLOAD);
  const bool serves = loaded &&
    std::all_of(names.begin(), names.end(),
      [loaded](const char* name) { return dlsym(loaded, name) == dlsym(RTLD_DEFAULT, name); });
  if (loaded)
  {
    dlclose(loaded);
  }
  return serves;
}

/// OpenCASCADE looks for its own symbols among its own libraries first: to look among ParaView's
/// before takes a quarter of a second. Not where memory comes from a preloaded allocator or a
/// sanitizer, nor where the program has the standard streams, as pvserver has: these would be
/// passed over as well, for streams that nobody has opened.
int LoadingMode()
{
#ifdef RTLD_DEEPBIND
  if (Serves("libc.so.6", { "malloc", "free" }) &&
    Serves("libstdc++.so.6", { "_Znwm", "_ZSt3cin", "_ZSt4cout", "_ZSt4cerr", "_ZSt4clog" }))
  {
    return RTLD_LAZY | RTLD_DEEPBIND;
  }
#endif
  return RTLD_LAZY;
}

LoadedReaders Load()
{
  LoadedReaders loaded;
  void* const library = dlopen(LibraryPath().c_str(), LoadingMode());
  const auto get = reinterpret_cast<decltype(&NURBSTrimGetCADReaders)>(
    library ? dlsym(library, "NURBSTrimGetCADReaders") : nullptr);
  if (get)
  {
    loaded.Readers = get();
  }
  else
  {
    const char* reason = dlerror();
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
