#include "bus/process.hpp"
#include "world/world_app.hpp"

int main(int argc, char** argv) {
  return priamos::bus::RunProcess<priamos::world::WorldApp>(argc, argv);
}
