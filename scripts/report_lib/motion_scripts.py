"""What happens in the section motion: one course of time for all scenes, and what walks, moves and is dimmed in each. A script is
what docs/script.md describes."""
import dataclasses


@dataclasses.dataclass(frozen=True)
class Phase:
    """A part of the script, in seconds of it; its end belongs to the next."""
    name: str
    begin: float
    end: float
    moves: bool = True

    def has(self, time):
        return self.begin <= time < self.end


WALK, OBJECT, LAMP = Phase("walk", 1, 3), Phase("object moves", 4, 5.5), Phase("lamp dims", 6.5, 7.5)
AFTER_OBJECT = Phase("after the object", 5.5, 6.5, False)
PHASES = (Phase("at rest", 0, 1, False), WALK, Phase("after the walk", 3, 4, False), OBJECT, AFTER_OBJECT, LAMP,
          Phase("after the lamp", 7.5, 9, False))
SECONDS = PHASES[-1].end
REST = 0.4  # so long before each change, and before the end, all methods are at rest [s]
SHOTS = 10  # a second


@dataclasses.dataclass(frozen=True)
class Course:
    """walk: cameras; dimmed: the lamp's emission at last [W/(m^2 sr)], about a quarter of what it was."""
    walk: tuple
    thing: str
    by: tuple  # [m]
    turn: float  # [degrees]
    lamp: str
    dimmed: tuple


COURSES = {
    "cornell": Course(("classic", "0.43,0.32,-0.7:0.24,0.22,0.28:40"), "short block", (0.02, 0, -0.1), -60, "lamp", (8.5, 6, 2)),
    "table_room": Course(("front", "0.75,1.45,1.6:0.05,0.8,-0.5:52"), "glass sphere", (-0.45, 0, 0.15), 0, "lamp", (6.5, 6.1, 5.5)),
    "office": Course(("from the corner", "1.2,1.55,1.7:-0.25,0.8,-0.6:54"), "main chair", (0.9, 0, 0.25), 70, "ceiling light",
                     (5.2, 5, 4.4)),
}


def script(course, **how):
    """how: shots of a session in real time, or rate and frames of its truth."""
    return {"seconds": SECONDS, **how, "events": [
        {"from": WALK.begin, "to": WALK.end, "camera": list(course.walk)},
        {"from": OBJECT.begin, "to": OBJECT.end, "object": course.thing, "by": list(course.by), "turn": course.turn},
        {"from": LAMP.begin, "to": LAMP.end, "material": course.lamp, "emission": list(course.dimmed)}]}


def count(rate):
    """Of the pictures of a script: at 0, 1/rate, ... SECONDS."""
    return int(SECONDS * rate + 1e-9) + 1
