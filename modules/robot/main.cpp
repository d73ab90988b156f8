#include "bus/process.hpp"
#include "robot/robot_app.hpp"

int main(int argc, char** argv) {
  return priamos::bus::RunProcess<priamos::robot::RobotApp>(argc, argv);
}
