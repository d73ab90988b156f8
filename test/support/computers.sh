# Shell functions for several computers on one switch, inside a private network (`unshare -rnu`) and without root; files go to $DIR:
#
#     host NAME ADDRESS [US]  a computer of that name with eth9, which is on the switch; no route for multicast. US: its
#                             processes agree on a clock that is so many microseconds ahead of this machine's
#     on NAME COMMAND         runs a command there
#     start NAME COMMAND      the same in the background; its process is in $STARTED
#     end_started             ends what was started
#     cut_off NAME            nothing arrives at it any more
#     cut_bus NAME            no multicast arrives at it any more
#     whole NAME              everything arrives again
#     off                     ends all of them and what was started; also when the script ends
ip link add hub type bridge mcast_snooping 0 && ip link set hub up
HOSTS= RUNNING=
host() {
  unshare -nu bash -c "hostname $1; echo > $DIR/up-$1; exec sleep ${COMPUTERS_FOR:-300}" & eval "HOST_$1=$!"; HOSTS="$HOSTS $!"
  local pid=$!
  until [ -e $DIR/up-$1 ]; do sleep 0.02; done
  rm $DIR/up-$1
  [ -z "${3:-}" ] || own_clock $1 $3
  ip link add port-$1 type veth peer name eth9 netns $pid && ip link set port-$1 master hub up
  on $1 bash -c "ip link set lo up multicast on; ip addr add $2/24 dev eth9; ip link set eth9 up multicast on"
}
own_clock() {  # the file that the first process of a host would write
  local anchor=$(($(date +%s%6N) - $(cut -d' ' -f1 /proc/uptime | tr -d .)0000))
  local file=$DIR/clock-$1/clock-$(cat /proc/sys/kernel/random/boot_id)-$(stat -Lc %i /proc/self/ns/time)
  mkdir -p -m 700 $DIR/clock-$1
  (umask 077; printf 'priamos clock anchor 1\n%d\n' $((anchor + $2)) > $file)
}
in_host() {  # everything that a process of host $1 has of its own
  local pid; eval "pid=\$HOST_$1"
  echo nsenter -t $pid -n -u env $([ ! -d $DIR/clock-$1 ] || echo PRIAMOS_RUNTIME=$DIR/clock-$1) $(eval "echo \${ENV_$1:-}")
}
on() { $(in_host $1) "${@:2}"; }
start() { local inside; inside=$(in_host $1); $inside "${@:2}" & STARTED=$!; RUNNING="$RUNNING $!"; }
end_started() { [ -z "$RUNNING" ] || { kill $RUNNING; wait $RUNNING; } 2> /dev/null || :; RUNNING=; }
cut_off() {
  ip link set port-$1 type bridge_slave learning off flood off mcast_flood off bcast_flood off
  ip link set port-$1 type bridge_slave fdb_flush
}
cut_bus() { ip link set port-$1 type bridge_slave mcast_flood off; }
whole() { ip link set port-$1 type bridge_slave learning on flood on mcast_flood on bcast_flood on; }
off() { end_started; [ -z "$HOSTS" ] || { kill $HOSTS; wait $HOSTS; } 2> /dev/null || :; HOSTS=; }
trap off EXIT
