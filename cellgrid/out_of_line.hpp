// For functions whose bits are not to depend on what the compiler would merge them with, from place to place
// and build to build.
#pragma once

#define FRESHET_OUT_OF_LINE __attribute__((noinline))
