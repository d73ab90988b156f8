#pragma once

#include <string>

namespace priamos {

/// Shell functions for several computers on one switch, inside a private network and without root:
///
///     host NAME ADDRESS    a computer of that name with eth9, which is on the switch; no route for multicast
///     on NAME COMMAND      runs a command there
///     start NAME COMMAND   the same in the background; its process is in $STARTED
///     cut_off NAME         nothing arrives at it any more
///     cut_bus NAME         no multicast arrives at it any more
///     whole NAME           everything arrives again
///     off                  ends all of them and what was started; also when the script ends
inline const std::string kComputers = R"sh(
ip link add hub type bridge mcast_snooping 0 && ip link set hub up
HOSTS= RUNNING=
host() {
  unshare -nu bash -c "hostname $1; echo > $DIR/up-$1; exec sleep 300" & eval "HOST_$1=$!"; HOSTS="$HOSTS $!"
  local pid=$!
  until [ -e $DIR/up-$1 ]; do sleep 0.02; done
  ip link add port-$1 type veth peer name eth9 netns $pid && ip link set port-$1 master hub up
  on $1 bash -c "ip link set lo up multicast on; ip addr add $2/24 dev eth9; ip link set eth9 up multicast on"
}
on() { local pid; eval "pid=\$HOST_$1"; shift; nsenter -t $pid -n -u "$@"; }
start() {
  local pid; eval "pid=\$HOST_$1"; shift
  nsenter -t $pid -n -u "$@" & STARTED=$!; RUNNING="$RUNNING $!"
}
cut_off() {
  ip link set port-$1 type bridge_slave learning off flood off mcast_flood off bcast_flood off
  ip link set port-$1 type bridge_slave fdb_flush
}
cut_bus() { ip link set port-$1 type bridge_slave mcast_flood off; }
whole() { ip link set port-$1 type bridge_slave learning on flood on mcast_flood on bcast_flood on; }
off() { kill $RUNNING $HOSTS 2> /dev/null; wait $RUNNING $HOSTS 2> /dev/null; }
trap off EXIT
)sh";

}  // namespace priamos
