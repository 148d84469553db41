// freshet: see src/run/commands/cli.cpp for the commands.
#include "src/run/commands/cli.hpp"

int main(int argc, char** argv) { return freshet::run_cli(argc, argv); }
