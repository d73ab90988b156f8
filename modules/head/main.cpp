#include "bus/process.hpp"
#include "head/head_app.hpp"

int main(int argc, char** argv) {
  return priamos::bus::RunProcess<priamos::head::HeadApp>(argc, argv);
}
