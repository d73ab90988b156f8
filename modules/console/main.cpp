#include "bus/process.hpp"
#include "console/console_app.hpp"
#include "console/played_log.hpp"

int main(int argc, char** argv) {
  return priamos::bus::RunProcess<priamos::console::ConsoleApp>(argc, argv, priamos::console::ShowPlayedLog);
}
