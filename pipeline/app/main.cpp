// The program `crevice`.
#include "app/commands/Program.h"

int main(int argc, char** argv) { return crevice::runProgram(argc, argv); }
