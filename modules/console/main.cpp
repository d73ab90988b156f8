#include "bus/process.hpp"
#include "console/console_app.hpp"

int main(int argc, char** argv) {
  return priamos::bus::RunProcess<priamos::console::ConsoleApp>(argc, argv);
}
