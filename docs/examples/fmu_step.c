/* Steps an exported stand from C through the functions of FMI 2.0, without any library.

       millstand export fmu cases/published-1400.toml -o stand.fmu
       unzip -o stand.fmu -d unit
       cc -O2 -o fmu_step docs/examples/fmu_step.c -ldl -lm
       ./fmu_step unit

   For Windows: x86_64-w64-mingw32-gcc -O2 -o fmu_step.exe docs/examples/fmu_step.c                                 */
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

int main(int argc, char **argv)
{
  static char description[1 << 18];
  char path[4096], guid[64], identifier[128], location[4096];
  const struct callbacks callbacks = {print_message, NULL, NULL, NULL, NULL};
  const double step = 5e-5, mean = 976e3, pi = 3.14159265358979323846;
  const int order   = 1;
  double peak = 0, force = mean;
  unsigned F_roll, a_upper;
  Component c;
  FILE *file;
  int i, failed = 0;
  if (argc < 2)
    return fprintf(stderr, "usage: fmu_step FOLDER (of an unpacked unit)\n"), 2;
  snprintf(path, sizeof path, "%s/modelDescription.xml", argv[1]);
  file = fopen(path, "rb");
  if (!file || fread(description, 1, sizeof description - 1, file) == 0)
    return fprintf(stderr, "cannot read %s\n", path), 1;
  fclose(file);
  attribute(description, "<fmiModelDescription", "guid", guid, sizeof guid);
  attribute(description, "<CoSimulation", "modelIdentifier", identifier, sizeof identifier);
  F_roll  = reference(description, "F_roll");
  a_upper = reference(description, "a_upper_work_roll");

  snprintf(path, sizeof path, "%s/binaries/" PLATFORM "/%s." LIBRARY, argv[1], identifier);
  library = open_library(path);
  if (!library)
    return fprintf(stderr, "%s does not load\n", path), 1;
  snprintf(location, sizeof location, "%s/resources", argv[1]); /* a plain path; other units want file:///... */
  c = ((Component(*)(const char *, int, const char *, const char *, const struct callbacks *, int, int))function(
      "fmi2Instantiate"))("stand", 1, guid, location, &callbacks, 0, 0);
  if (!c)
    return 1;
  failed |= ((int (*)(Component, int, double, double, int, double))function("fmi2SetupExperiment"))(c, 0, 0, 0, 0, 0);
  failed |= ((int (*)(Component))function("fmi2EnterInitializationMode"))(c);
  {
    int (*set)(Component, const unsigned *, size_t, const double *) =
        (int (*)(Component, const unsigned *, size_t, const double *))function("fmi2SetReal");
    int (*get)(Component, const unsigned *, size_t, double *) =
        (int (*)(Component, const unsigned *, size_t, double *))function("fmi2GetReal");
    int (*slope)(Component, const unsigned *, size_t, const int *, const double *) =
        (int (*)(Component, const unsigned *, size_t, const int *, const double *))function(
            "fmi2SetRealInputDerivatives");
    int (*do_step)(Component, double, double, int) =
        (int (*)(Component, double, double, int))function("fmi2DoStep");
    failed |= set(c, &F_roll, 1, &force);
    failed |= ((int (*)(Component))function("fmi2ExitInitializationMode"))(c);
    for (i = 0; i < 20000 && !failed; ++i) { /* 1 s, the force in straight lines */
      const double next = mean + 3e3 * sin(2 * pi * 39 * (i + 1) * step), rate = (next - force) / step;
      double a;
      failed |= set(c, &F_roll, 1, &force);
      failed |= slope(c, &F_roll, 1, &order, &rate);
      failed |= do_step(c, i * step, step, 1);
      failed |= get(c, &a_upper, 1, &a);
      peak  = fmax(peak, fabs(a));
      force = next;
    }
  }
  ((void (*)(Component))function("fmi2FreeInstance"))(c);
  printf("upper work roll: peak %.4f g\n", peak / 9.80665);
  return failed;
}
