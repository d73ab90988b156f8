#include "bus/process.hpp"
#include "planner/planner_app.hpp"

int main(int argc, char** argv) {
  return priamos::bus::RunProcess<priamos::planner::PlannerApp>(argc, argv);
}
