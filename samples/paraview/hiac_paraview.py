"""hiac picture of this view: a macro for ParaView (Macros, Import new macro).

Saves the state and the data of the active source to a temporary folder, lets hiac-render draw the active
view from them, and opens the picture. hiac-render is looked for on PATH; HIAC_RENDER may name another.
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

# How ParaView saves each kind of data, and what reads that; blocks are merged into one grid.
WRITERS = {"vtkUnstructuredGrid": (".vtu", "XMLUnstructuredGridReader"),
           "vtkImageData": (".vti", "XMLImageDataReader"),
           "vtkRectilinearGrid": (".vtr", "XMLRectilinearGridReader"),
           "vtkStructuredGrid": (".vts", "XMLStructuredGridReader")}


def read_saved_data(state, source, reader, data):
    """Makes a state read the saved data where it had a source, whatever computed them."""
    tree = ElementTree.parse(state)
    for proxy in tree.getroot().iter("Proxy"):
        if proxy.get("group") and proxy.get("id") == source:
            for child in list(proxy):
                proxy.remove(child)
            proxy.set("group", "sources")
            proxy.set("type", reader)
            name = ElementTree.SubElement(proxy, "Property", {"name": "FileName"})
            ElementTree.SubElement(name, "Element", {"index": "0", "value": str(data)})
    tree.write(state)


def save(folder):
    """Saves state and data of the active view and source; returns the state's view for --view."""
    from paraview import servermanager, simple
    view, source = simple.GetActiveView(), simple.GetActiveSource()
    if view is None or source is None:
        sys.exit("hiac: a render view and a source have to be active")
    source.UpdatePipeline()
    kind = source.GetDataInformation().GetDataSetTypeAsString()
    saved = source if kind in WRITERS else simple.MergeBlocks(registrationName="hiac", Input=source)
    extension, reader = WRITERS.get(kind, WRITERS["vtkUnstructuredGrid"])
    data, state = folder / ("data" + extension), folder / "view.pvsm"
    simple.SaveData(str(data), proxy=saved)
    if saved is not source:
        simple.Delete(saved)
    servermanager.SaveState(str(state))
    read_saved_data(state, source.GetGlobalIDAsString(), reader, data)
    return f"{state}#{servermanager.ProxyManager().GetProxyName('views', view)}"


def open_picture(picture):
    if sys.platform == "win32":
        os.startfile(picture)
    else:
        subprocess.Popen(["open" if sys.platform == "darwin" else "xdg-open", str(picture)])


def main():
    program = os.environ.get("HIAC_RENDER") or shutil.which("hiac-render")
    if program is None:
        sys.exit("hiac: hiac-render is not on PATH (HIAC_RENDER names it)")
    folder = pathlib.Path(tempfile.mkdtemp(prefix="hiac-"))
    picture = folder / "picture.png"
    done = subprocess.run([program, "--view", save(folder), "-o", str(picture)], stdin=subprocess.DEVNULL,
                          stderr=subprocess.PIPE, text=True, check=False)
    print(done.stderr)
    if done.returncode != 0:
        sys.exit(f"hiac-render ended with {done.returncode}")
    print("hiac picture:", picture)
    if os.environ.get("HIAC_OPEN", "1") != "0":
        open_picture(picture)


if __name__ in ("__main__", "__vtkconsole__"):
    main()
