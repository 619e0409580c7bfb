#include "viewer/commands/command_line.h"

int main(int argc, char** argv) {
    return lightwell::run_command_line(argc, argv);
}
