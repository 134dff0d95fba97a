/* Lets an exported chatter unit vibrate at several speeds of the rolls, from C and without any library (FMI 2.0).

       millstand export fmu cases/chatter-tandem.toml --pass 2 -o chatter.fmu
       unzip -o chatter.fmu -d unit
       cc -O2 -o chatter_step docs/examples/chatter_step.c -ldl -lm
       ./chatter_step unit

   For Windows: x86_64-w64-mingw32-gcc -O2 -o chatter_step.exe docs/examples/chatter_step.c                         */
#ifdef _WIN32
#include <windows.h>
#define PLATFORM "win64"
#define LIBRARY "dll"
#else
#define _GNU_SOURCE
#include <dlfcn.h>
#define PLATFORM "linux64"
#define LIBRARY "so"
#endif
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef void *Component;
struct callbacks {
  void (*logger)(void *, const char *, int, const char *, const char *, ...);
  void *(*allocate)(size_t, size_t);
  void (*release)(void *);
  void (*finished)(void *, int);
  void *environment;
};

static void *library;

static void *open_library(const char *path)
{
#ifdef _WIN32
  return (void *)LoadLibraryA(path);
#else
  return dlopen(path, RTLD_NOW | RTLD_LOCAL);
#endif
}

static void print_message(void *environment, const char *name, int status, const char *category, const char *text, ...)
{
  va_list more;
  (void)environment, (void)status;
  va_start(more, text);
  fprintf(stderr, "%s, %s: ", name, category);
  vfprintf(stderr, text, more);
  fprintf(stderr, "\n");
  va_end(more);
}

/* A function of the unit; the caller casts it to its type. */
static void *function(const char *name)
{
#ifdef _WIN32
  void *found = (void *)GetProcAddress((HMODULE)library, name);
#else
  void *found = dlsym(library, name);
#endif
  if (!found) {
    fprintf(stderr, "the library lacks %s\n", name);
    exit(1);
  }
  return found;
}

/* Text of an attribute of the element in which `name="..."` stands, from the description. */
static void attribute(const char *description, const char *element, const char *name, char *value, size_t size)
{
  char wanted[64];
  const char *at = strstr(description, element), *end;
  snprintf(wanted, sizeof wanted, " %s=\"", name);
  at = at ? strstr(at, wanted) : NULL;
  if (!at) {
    fprintf(stderr, "no %s of %s\n", name, element);
    exit(1);
  }
  at += strlen(wanted);
  end = strchr(at, '"');
  snprintf(value, size, "%.*s", (int)(end - at), at);
}

static unsigned reference(const char *description, const char *variable)
{
  char element[128], value[32];
  snprintf(element, sizeof element, "<ScalarVariable name=\"%s\"", variable);
  attribute(description, element, "valueReference", value, sizeof value);
  return (unsigned)strtoul(value, NULL, 10);
}

typedef int (*set_function)(Component, const unsigned *, size_t, const double *);
typedef int (*get_function)(Component, const unsigned *, size_t, double *);

/* Largest change of the gap in each of n parts of a run, from the disturbance that the unit starts with. */
static int swings(Component c, const char *description, double speed, double part, int n, double *largest)
{
  const set_function set = (set_function)function("fmi2SetReal");
  const get_function get = (get_function)function("fmi2GetReal");
  int (*const do_step)(Component, double, double, int) =
      (int (*)(Component, double, double, int))function("fmi2DoStep");
  const unsigned roll_speed = reference(description, "roll_speed"), dh = reference(description, "dh");
  const double step = 5e-4;
  const int steps = (int)(part / step + 0.5);
  int i, failed = ((int (*)(Component))function("fmi2Reset"))(c);
  failed |= set(c, &roll_speed, 1, &speed);
  failed |= ((int (*)(Component, int, double, double, int, double))function("fmi2SetupExperiment"))(c, 0, 0, 0, 0, 0);
  failed |= ((int (*)(Component))function("fmi2EnterInitializationMode"))(c);
  failed |= ((int (*)(Component))function("fmi2ExitInitializationMode"))(c);
  for (i = 0; i < n; ++i)
    largest[i] = 0;
  for (i = 0; i < n * steps && !failed; ++i) {
    double gap = 0;
    failed |= do_step(c, i * step, step, 1);
    failed |= get(c, &dh, 1, &gap);
    largest[i / steps] = fmax(largest[i / steps], fabs(gap));
  }
  return failed;
}

int main(int argc, char **argv)
{
  static char description[1 << 18];
  char path[4096], guid[64], identifier[128], location[4096];
  const struct callbacks callbacks = {print_message, NULL, NULL, NULL, NULL};
  const double part = 0.15; /* s */
  Component c;
  FILE *file;
  int speed, failed = 0;
  if (argc < 2)
    return fprintf(stderr, "usage: chatter_step FOLDER (of an unpacked unit)\n"), 2;
  snprintf(path, sizeof path, "%s/modelDescription.xml", argv[1]);
  file = fopen(path, "rb");
  if (!file || fread(description, 1, sizeof description - 1, file) == 0)
    return fprintf(stderr, "cannot read %s\n", path), 1;
  fclose(file);
  attribute(description, "<fmiModelDescription", "guid", guid, sizeof guid);
  attribute(description, "<CoSimulation", "modelIdentifier", identifier, sizeof identifier);
  snprintf(path, sizeof path, "%s/binaries/" PLATFORM "/%s." LIBRARY, argv[1], identifier);
  library = open_library(path);
  if (!library)
    return fprintf(stderr, "%s does not load\n", path), 1;
  snprintf(location, sizeof location, "%s/resources", argv[1]); /* a plain path; other units want file:///... */
  c = ((Component(*)(const char *, int, const char *, const char *, const struct callbacks *, int, int))function(
      "fmi2Instantiate"))("stand", 1, guid, location, &callbacks, 0, 0);
  if (!c)
    return 1;
  for (speed = 14; speed <= 22 && !failed; speed += 4) {
    double largest[4];
    failed |= swings(c, description, speed, part, 4, largest);
    printf("%d m/s: swings of %.2e m, then %.2e m: growth %.1f 1/s\n", speed, largest[1], largest[3],
           log(largest[3] / largest[1]) / (2 * part));
  }
  ((void (*)(Component))function("fmi2FreeInstance"))(c);
  return failed;
}
