#include "bus/process.hpp"
#include "radio/radio_app.hpp"

int main(int argc, char** argv) {
  return priamos::bus::RunProcess<priamos::radio::RadioApp>(argc, argv);
}
