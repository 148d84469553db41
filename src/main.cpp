// freshet: see src/run/cli.cpp for the commands.
#include "src/run/cli.hpp"

int main(int argc, char** argv) { return freshet::run_cli(argc, argv); }
