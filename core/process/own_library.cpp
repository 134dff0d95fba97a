#include "core/process/own_library.h"
#include "core/base/errors.h"
#include "core/base/vector_alignment.h"
#include <cerrno>
#include <cstring>
#include <dlfcn.h>
#include <filesystem>
#include <link.h>
#include <new>
#include <string>

namespace mill {
namespace {
[[noreturn]] void refuse_library(const std::string &path, const std::string &why)
{
  throw SystemError("the finite elements are a library in the folder of the program, '" + path +
                    "', which cannot be used: " + why +
                    "; install the package millstand-fem of the same version, or build both together (cmake "
                    "--build --preset release --target millstand)");
}

// What the loader says where the address space ends: it names no reason where mmap() fails for want of it.
bool has_no_room(const std::string &why)
{
  const std::string unmapped = "failed to map segment from shared object";
  return why.find(std::strerror(ENOMEM)) != std::string::npos ||
         (why.size() >= unmapped.size() &&
          why.compare(why.size() - unmapped.size(), unmapped.size(), unmapped) == 0);
}

// By its name first: the loader then looks into the folders that this program or module was linked with, and there
// takes the library for newer processors if the package has one (glibc-hwcaps/x86-64-v3).  A sanitizer stands
// between program and loader and hides those folders; there, and where both were copied, the path is taken.
void *open_library(const std::string &name, std::string &path)
{
  path = own_folder() + "/" + name;
  if (void *const opened = dlopen(name.c_str(), RTLD_LAZY | RTLD_LOCAL); opened != nullptr) {
    link_map *loaded = nullptr;
    if (dlinfo(opened, RTLD_DI_LINKMAP, &loaded) == 0)
      path = loaded->l_name;
    return opened;
  }
  return dlopen(path.c_str(), RTLD_LAZY | RTLD_LOCAL);
}
}  // namespace

std::string own_folder()
{
  Dl_info info{};
  void *map = nullptr;
  // The loader knows a library by its path and the program by an empty name.
  if (dladdr1(reinterpret_cast<void *>(&own_folder), &info, &map, RTLD_DL_LINKMAP) != 0 && map != nullptr)
    if (const std::string name = static_cast<const link_map *>(map)->l_name; !name.empty())
      return std::filesystem::canonical(name).parent_path();
  return std::filesystem::read_symlink("/proc/self/exe").parent_path();
}

void *function_of_own_library(const char *library, const char *function)
{
  std::string path;
  void *const opened = open_library(library, path);
  if (opened == nullptr) {
    const std::string why = dlerror();
    if (has_no_room(why))
      throw std::bad_alloc();
    refuse_library(path, why);
  }
  const auto *build  = static_cast<const char *const *>(dlsym(opened, "millstand_build"));
  void *const symbol = dlsym(opened, function);
  if (build == nullptr || symbol == nullptr || std::string(*build) != MILLSTAND_BUILD)
    refuse_library(path, "it is of another build");
  const auto *alignment = static_cast<const int *>(dlsym(opened, "millstand_vector_alignment"));
  if (alignment == nullptr || *alignment != vector_alignment)
    refuse_library(path, "its vectors are aligned in another way");
  return symbol;
}
}  // namespace mill
