"""The example scripts that users copy, run as users run them, with numbers known on paper."""
import csv
import math
import os
import shutil
import subprocess
import sys

from paraview.simple import OpenDataFile, PassArrays, SaveData, Sphere, Transform

from Checks import ELEMENT_COUNT, LENGTHS, OUTPUT_DIRECTORY, check, check_close, check_equal, sheet

EXAMPLES = os.environ["NURBSTRIM_EXAMPLES"]
sys.path.insert(0, EXAMPLES)
import ResultFile  # noqa: E402
DIRECTORY = os.path.join(OUTPUT_DIRECTORY, "examples")


def path(*names):
    return os.path.join(DIRECTORY, *names)


def run(script, *options, status=0):
    done = subprocess.run(["pvpython", "--dr", os.path.join(EXAMPLES, script)] + list(options),
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    check_equal(done.returncode, status, "exit status of %s\n%s" % (script, done.stdout))
    return done.stdout


def cells(name):
    mesh = OpenDataFile(path(name))
    mesh.UpdatePipeline()
    return mesh.GetDataInformation().GetNumberOfCells()


def check_surface(plane):
    """The plane x = 8.3: 8 rows stay on its near side, 12 on the side of the kept point."""
    text = run("TrimWithSurface.py", path("sheet.vtu"), plane, path("near.vtu"))
    printed = dict(line.split() for line in text.splitlines() if len(line.split()) == 2)
    check_equal(int(printed["Kept"]), 8 * 24, "Kept")
    check_close(float(printed["Volume"]), 8.3 * 12 * 0.5, "Volume", 1e-6)
    check_equal(cells("near.vtu"), 8 * 24, "elements in the file")
    text = run("TrimWithSurface.py", path("sheet.vtu"), plane, path("far.vtu"), "--keep", "19", "6",
               "0", "--type", "1")
    check("MinimumScaledJacobian nan" in " ".join(text.split()), "no touched element:\n" + text)
    check_equal(cells("far.vtu"), 12 * 24, "elements on the side that was kept")
    text = run("TrimWithSurface.py", path("sheet.vtu"), path("none.igs"), path("x.vtu"), status=1)
    check("There is no file" in text, "no word of the missing file:\n" + text)
    run("TrimWithSurface.py", path("sheet.vtu"), plane, path("far.vtu"), "--keep", "-100", "6",
        "-5e-1")
    check_equal(cells("far.vtu"), 8 * 24, "elements on the side of a point with signs")
    check_no_result("TrimWithSurface.py", path("sheet.vtu"), plane)
    run("TrimWithSurface.py", path("sheet.vtu"), plane, path("x.vtu"), "--opne", status=2)
    check(not os.path.exists(path("x.vtu")), "a result in spite of a wrong option")


def check_no_result(script, *inputs):
    """Nothing is trimmed for a file that could not be written."""
    text = run(script, *inputs, path("x.stl"), status=1)
    check("directory that exists, not " + path("x.stl") in text, "no word of the ending:\n" + text)
    # A directory that nobody may write in.
    text = run(script, *inputs, "/proc/x.vtu", status=1)
    check("/proc/x.vtu cannot be written" in text, "no word of a failure to write:\n" + text)


def check_result_names():
    """What both scripts ask of the result's name before they trim."""
    os.makedirs(path("taken.vtu"))
    for result in (path("none", "x.vtu"), path("x.stl"), path("taken.vtu")):
        check(not ResultFile.can_be(result), result + " is taken for the name of a result")
    check(ResultFile.can_be(path("x.vtu")), "the name of a result is not taken")


def check_points():
    """A round hole of radius 3; its area lies between those of the polygon and the circle."""
    points = [(10 + 3 * math.cos(a), 6 + 3 * math.sin(a), 0.25)
              for a in (2 * math.pi * i / 24 for i in range(24))]
    whole = LENGTHS[0] * LENGTHS[1] * LENGTHS[2]
    for header, between in (("x,y,z", ","), ("x;y;z", ";"), ("# a circle", " ")):
        with open(path("circle.csv"), "w") as file:
            file.write(header + "\n")
            file.writelines(between.join(map(repr, point)) + "\n" for point in points)
        text = run("TrimByPoints.py", path("sheet.vtu"), path("circle.csv"), path("hole.vtu"))
        removed = (whole - float(text.split("volume")[1].split()[0])) / LENGTHS[2]
        check(0.9 < removed / (math.pi * 9) < 1, "area of the hole %g" % removed)
    with open(path("cut.csv"), "w") as file:
        file.write("8.3;-3;0\n8.3;6;0\n8.3;15;0\n")
    text = run("TrimByPoints.py", path("sheet.vtu"), path("cut.csv"), path("left.vtu"), "--open")
    volume = float(text.split("volume")[1].split()[0])
    check_close(volume, 8.3 * LENGTHS[1] * LENGTHS[2], "what lies to the left", 1e-6)
    with open(path("few.csv"), "w") as file:
        file.write("1,2,3\n")
    run("TrimByPoints.py", path("sheet.vtu"), path("few.csv"), path("x.vtu"), status=1)
    check_no_result("TrimByPoints.py", "--open", path("sheet.vtu"), path("cut.csv"))


def batch_table():
    """What the last batch wrote, by the mesh's file name."""
    with open(path("results", "trims.csv"), newline="") as file:
        return {row["mesh"]: row for row in csv.DictReader(file)}


def check_batch(plane):
    """Two good meshes, one of other cells and one that is no mesh: all four are in the table."""
    os.makedirs(path("meshes"))
    for name in ("a.vtu", "d.vtu"):
        shutil.copy(path("sheet.vtu"), path("meshes", name))
    with open(path("meshes", "b.vtu"), "w") as file:
        file.write("no mesh\n")
    SaveData(path("meshes", "c.vtk"), Sphere())
    text = run("TrimBatch.py", path("meshes"), plane, path("results"), status=1)
    check("2 of 4 meshes failed" in text, "the last line:\n" + text)
    rows = batch_table()
    check_equal(sorted(rows), ["a.vtu", "b.vtu", "c.vtk", "d.vtu"], "meshes in the table")
    for name in ("a.vtu", "d.vtu"):
        check_equal(rows[name]["state"], "trimmed", name)
        check_equal(int(rows[name]["Kept"]), 8 * 24, "Kept of " + name)
        check_close(float(rows[name]["Volume"]), 8.3 * 12 * 0.5, "Volume of " + name, 1e-6)
        check_equal(cells(os.path.join("results", name)), 8 * 24, "elements in " + name)
    for name in ("b.vtu", "c.vtk"):
        check_equal(rows[name]["state"], "failed", name)
        check(rows[name]["messages"], "no reason in the line of " + name)
        check(not os.path.exists(path("results", name)), "a result of " + name)


def check_batch_without_cut(plane):
    """A mesh that the plane misses stays whole, and has no worst touched element."""
    for directory in ("meshes", "results"):
        shutil.rmtree(path(directory))
    os.makedirs(path("meshes"))
    far = Transform(Input=sheet())
    far.Transform.Translate = [-100, 0, 0]
    SaveData(path("meshes", "far.vtu"), PassArrays(Input=far), DataMode="Binary")
    run("TrimBatch.py", path("meshes"), plane, path("results"))
    row = batch_table()["far.vtu"]
    check_equal(int(row["Kept"]), ELEMENT_COUNT, "Kept of a mesh that is missed")
    check_equal(row["MinimumScaledJacobian"], "", "worst touched element where there is none")
    check("misses the grid" in row["messages"], "no word of the miss: " + row["messages"])


def check_batch_names(plane):
    """Each of two meshes that differ in the ending alone has its result, and so has one that is
    named as the result of another would be; and no result takes the place of a mesh."""
    for directory in ("meshes", "results"):
        shutil.rmtree(path(directory))
    os.makedirs(path("meshes"))
    coarse = PassArrays(Input=sheet((10, 12, 2)))
    SaveData(path("meshes", "part.vtk"), coarse)
    for name in ("part.vtu", "part.vtu.vtu", "other.vtu"):
        shutil.copy(path("sheet.vtu"), path("meshes", name))
    run("TrimBatch.py", path("meshes"), plane, path("results"))
    check_equal(sorted(os.listdir(path("results"))),
                ["other.vtu", "part.vtk.vtu", "part.vtu.vtu", "part.vtu.vtu.vtu", "trims.csv"],
                "results")
    check_equal(sorted(batch_table()), sorted(os.listdir(path("meshes"))), "meshes in the table")
    # Of 10 columns of double width the plane leaves 4, of 20 it leaves 8.
    for name, kept in (("part.vtk.vtu", 4), ("part.vtu.vtu", 8)):
        check_equal(cells(os.path.join("results", name)), kept * 24, "elements in " + name)

    # What is no file cannot be written; the other results are not touched by that.
    os.remove(path("results", "other.vtu"))
    os.makedirs(path("results", "other.vtu"))
    run("TrimBatch.py", path("meshes"), plane, path("results"), status=1)
    check_equal(batch_table()["other.vtu"]["state"], "failed", "a result that cannot be written")
    check("other.vtu cannot be written" in batch_table()["other.vtu"]["messages"], "no word of that")
    check_equal(batch_table()["part.vtu"]["state"], "trimmed", "the next")

    text = run("TrimBatch.py", path("meshes"), plane, path("results", "..", "meshes"), status=1)
    check_equal(text, "The results would overwrite the meshes: name another directory for them.\n",
                "what is told of results among the meshes")
    check_equal(cells(os.path.join("meshes", "part.vtu")), ELEMENT_COUNT, "elements of the mesh")
    check(not os.path.exists(path("meshes", "trims.csv")), "a table among the meshes")


shutil.rmtree(DIRECTORY, ignore_errors=True)
os.makedirs(DIRECTORY)
SaveData(path("sheet.vtu"), PassArrays(Input=sheet()), DataMode="Binary")
plane_file = os.path.join(OUTPUT_DIRECTORY, "plane.igs")  # of WindowInput.py
check_result_names()
check_surface(plane_file)
check_points()
check_batch(plane_file)
check_batch_without_cut(plane_file)
check_batch_names(plane_file)
