#include "bus/process.hpp"
#include "teleop/teleop_app.hpp"

int main(int argc, char** argv) {
  return priamos::bus::RunProcess<priamos::teleop::TeleopApp>(argc, argv);
}
