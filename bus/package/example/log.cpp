// Prints how many messages a log holds.

#include <cstdio>

#include "bus/log/log_reader.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  priamos::bus::LogReader reader(argv[1]);
  int events = 0;
  while (reader.Next()) ++events;
  std::printf("%d\n", events);
  return 0;
}
