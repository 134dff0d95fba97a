#include "meshes/gmsh/gmsh_scope.h"
#include <exception>
#include <gmsh.h>

// Gmsh's initialisation sets whether FLTK shows tooltips, and FLTK writes each such option to ~/.fltk/fltk.org (of
// root also to /etc/fltk).  There is never a window, and a run writes to its own folder only: this definition is
// found before that of FLTK's library and does nothing.  (FLTK 1.3 has no switch for it.)
class __attribute__((visibility("default"))) Fl {
public:
  enum Fl_Option : unsigned {};
  static void option(Fl_Option which, bool value);
};

void Fl::option(Fl_Option, bool) {}

namespace mill::meshes {
GmshScope::GmshScope()
{
  gmsh::initialize(0, nullptr,
                   false);  // false: do not read the user's Gmsh options, results must not depend on them
  gmsh::option::setNumber("General.Terminal", 0);
  // Gmsh deletes this file in the home folder when it ends; the default name is that of a Gmsh of the user.
  gmsh::option::setString("General.TmpFileName", ".millstand-gmsh-tmp");
  gmsh::option::setNumber("General.NumThreads", 1);
  gmsh::option::setNumber("Geometry.Tolerance", 1e-11);  // m; patches have elements of some um on rolls of some m
  gmsh::option::setNumber("Mesh.MshFileVersion", 4.1);
  gmsh::option::setNumber("Mesh.Binary", 0);
  gmsh::model::add("millstand");
}

GmshScope::~GmshScope()
{
  gmsh::finalize();
}

std::string write_model(const std::string &path)
{
  try {
    gmsh::write(path);
  } catch (const std::string &message) {  // what Gmsh throws
    return message;
  } catch (const std::exception &e) {
    return e.what();
  }
  return "";
}

StackedLayers stacked(const std::vector<double> &layers)
{
  StackedLayers stack;
  stack.elements.assign(layers.size(), 1);
  for (const double layer : layers)
    stack.heights.push_back(stack.length += layer);
  for (double &height : stack.heights)
    height /= stack.length;
  return stack;
}
}  // namespace mill::meshes
