"""Drives the robot from pages of the station, ends each drive in another way, and prints how long the wheels turned on.

usage: station_driving.py BIN ROBOT PORT ROUNDS UP_JSON
"""
import sys

from station_rig import ENDS, Rig, report


def main():
    rig = Rig(sys.argv[1], sys.argv[2], int(sys.argv[3]), sys.argv[5])
    for how in ENDS:
        report(how, [rig.seconds_to_stand(how, (-1) ** i) for i in range(int(sys.argv[4]))])
    print(f"key held while a page connects: wheels {'turn' if rig.starts_while_held() else 'stand'}")
    rig.wheels.close()


main()
