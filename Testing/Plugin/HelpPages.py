"""The help file that the plugin carries: a page for every proxy, with its pictures, its properties
and the reference to the paper; and every picture and every page that one refers to is there. The
filter's page tells of the values of its arrays by the names that they have in the legends."""
import os
import re
import sqlite3
import sys
import xml.etree.ElementTree as ET
import zlib

help_file, image_directory, colors_file, xml_files = *sys.argv[1:4], sys.argv[4:]


def check(condition, text):
    if not condition:
        sys.exit("ERROR: " + text)


def files_in(path):
    """Name to content of a Qt help file: an SQLite data base of Qt's compressed blocks."""
    base = sqlite3.connect(path)
    rows = base.execute("select Name, Data from FileNameTable, FileDataTable "
                        "where FileNameTable.FileId = FileDataTable.Id and Data is not null")
    return {name: zlib.decompress(data[4:]) for name, data in rows}


def proxies():
    for path in xml_files:
        for group in ET.parse(path).getroot().iter("ProxyGroup"):
            for proxy in group.iter("SourceProxy"):
                labels = [p.get("label", p.get("name")) for p in proxy
                          if p.tag.endswith("Property") and p.find("Documentation") is not None]
                yield "%s.%s.html" % (group.get("name"), proxy.get("name")), labels


def named_values():
    """Array and "value name" of all that the legends name."""
    with open(colors_file) as file:
        maps = re.findall(r'"(\w+)" : \{ "PVLookupTable" : \{(.*?)\}', file.read(), re.DOTALL)
    for array, properties in maps:
        for annotations in re.findall(r'"Annotations" : \[(.*?)\]', properties, re.DOTALL):
            words = re.findall(r'"([^"]*)"', annotations)
            for value, name in zip(words[::2], words[1::2]):
                yield array, value + " " + name


files = files_in(help_file)
count = 0
for name, labels in proxies():
    check(name in files, "there is no page " + name)
    page = files[name].decode()
    check("<img" in page, "no picture in " + name)
    check("Finite Elements in Analysis" in page, "no reference in " + name)
    check(labels, "no properties of " + name)
    for label in labels:
        check("<th>%s</th>" % label in page, "%s does not tell of %s" % (name, label))
    count += 1
check(count == 4, "%d proxies with a page" % count)

for name, content in files.items():
    if not name.endswith(".html"):
        continue
    for target in re.findall(r'(?:src|href)="([^"]+)"', content.decode()):
        check(target in files, "%s refers to %s, which is not there" % (name, target))
        if target.endswith(".png"):
            with open(os.path.join(image_directory, target), "rb") as file:
                check(files[target] == file.read(), target + " is not the picture of that name")

rows = {}
page = files["filters.TrimHexahedralGrid.html"].decode()
for row in re.findall("<tr>(.*?)</tr>", page, re.DOTALL):
    cells = [" ".join(cell.split()) for cell in re.findall("<td>(.*?)</td>", row, re.DOTALL)]
    rows[cells[0] if cells else ""] = cells[-1:]
named = list(named_values())
check(len(named) > 30, "%d values with a name" % len(named))
for array, value in named:
    check(array in rows, "the filter's page does not tell of " + array)
    check(value in rows[array][0], "the filter's page does not tell of %s %s" % (array, value))
