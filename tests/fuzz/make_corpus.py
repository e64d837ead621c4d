"""Writes the seeds of the fuzz targets, one folder per format: small files that use most of what a format knows.

    make_corpus.py FOLDER
"""
import pathlib
import struct
import sys

XYZ = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, float("nan"))]
TRIANGLES = [(0, 2, 1), (0, 1, 3)]


def pcd_header(data, points=4):
    return (f"# .PCD v0.7\nVERSION 0.7\nFIELDS x y z rgb label _\nSIZE 4 4 4 4 2 1\nTYPE F F F U U U\n"
            f"COUNT 1 1 1 1 2 3\nWIDTH {points // 2}\nHEIGHT 2\nVIEWPOINT 0 0 1 1 0 0 0\nPOINTS {points}\n"
            f"DATA {data}\n").encode()


def lzf_literals(data):
    """Valid LZF without any back reference."""
    return b"".join(bytes([len(data[i:i + 32]) - 1]) + data[i:i + 32] for i in range(0, len(data), 32))


def pcd():
    rows = [struct.pack("<3fI2H3B", *p, 0xff8040, 1, 2, 0, 0, 0) for p in XYZ]
    columns = b"".join(struct.pack("<4f", *axis) for axis in zip(*XYZ)) + bytes(16) + bytes(16)
    packed = lzf_literals(columns)
    back_reference = b"\x00\x00" + b"\xe0\x46\x00"  # a zero, then 79 times the byte before
    yield b"ascii", pcd_header("ascii") + b"".join(b"%g %g %g 255 1 2 0 0 0\n" % p for p in XYZ)
    yield b"binary", pcd_header("binary") + b"".join(rows)
    yield b"compressed", pcd_header("binary_compressed") + struct.pack("<II", len(packed), len(columns)) + packed
    yield b"references", (pcd_header("binary_compressed") + struct.pack("<II", len(back_reference), len(columns)) +
                          back_reference)
    yield b"names", b"fields \"X\" Points_m_XYZ:1 Elevation R G B Normals:0\npoints 1\ndata ascii\n1 2 3 4 5 6 7\nmore"
    yield b"old", b"COLUMNS x y z\nPOINTS 1\nDATA ascii\n1 2 3\n"


CAMERA = ["view_px", "view_py", "view_pz", "x_axisx", "x_axisy", "x_axisz", "y_axisx", "y_axisy", "y_axisz",
          "z_axisx", "z_axisy", "z_axisz", "focal"]
POSE = [1, 2, 3, 0, 1, 0, -1, 0, 0, 0, 0, 1, 5]


def ply_header(form):
    return (f"ply\nformat {form} 1.0\ncomment seed\nobj_info num_cols 2\nobj_info num_rows 2\nelement vertex 4\n"
            "property double x\nproperty float y\nproperty float z\nproperty uchar red\nproperty list uchar short extra\n"
            "element face 2\nproperty list uchar int vertex_indices\nproperty uchar flag\nelement tristrips 1\n"
            "property list int int vertex_indices\nelement camera 1\n" +
            "".join(f"property float {name}\n" for name in CAMERA) + "end_header\n").encode()


def ply():
    lines = b"".join(b"%g %g %g 7 2 5 6\n" % p for p in XYZ) + b"".join(b"3 %d %d %d 1\n" % t for t in TRIANGLES)
    yield b"ascii", ply_header("ascii") + lines + b"5 0 1 2 -1 3\n" + " ".join(map(str, POSE)).encode()
    for form, order in (("binary_little_endian", "<"), ("binary_big_endian", ">")):
        body = b"".join(struct.pack(order + "dffBB2h", *p, 7, 2, 5, 6) for p in XYZ)
        body += b"".join(struct.pack(order + "B3iB", 3, *t, 1) for t in TRIANGLES)
        body += struct.pack(order + "6i", 5, 0, 1, 2, -1, 3) + struct.pack(order + "13f", *POSE)
        yield form.encode(), ply_header(form) + body


def las(minor, point_format, extra=True):
    sizes = [20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67]
    record = sizes[point_format] + (6 if extra else 0)
    header_bytes = 375 if minor == 4 else 235 if minor == 3 else 227
    descriptor = bytearray(192)
    descriptor[2:4] = bytes([3, 0x18])  # an unsigned short with scale and offset
    descriptor[4:10] = b"height"
    struct.pack_into("<d", descriptor, 112, 0.01)
    struct.pack_into("<d", descriptor, 136, 5.0)
    record_header = struct.pack("<H16sHH32s", 0, b"LASF_Spec", 4, 192, b"")
    records = record_header + bytes(descriptor) if extra else b""
    header = bytearray(header_bytes)
    header[0:4] = b"LASF"
    header[24:26] = bytes([1, minor])
    struct.pack_into("<HIIBHI", header, 94, header_bytes, header_bytes + len(records), int(extra), point_format, record,
                     0 if minor == 4 else 3)
    struct.pack_into("<6d", header, 131, 0.01, 0.01, 0.001, 500000.0, 5400000.0, 100.0)
    if minor == 4:
        struct.pack_into("<Q", header, 247, 3)
    body = b"".join(struct.pack("<3i", 100 * i, i * i, -i) + bytes(range(record - 12)) for i in range(3))
    return bytes(header) + records + body


def stl():
    facet = struct.pack("<12fH", 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0)
    yield b"binary", b"solid but binary".ljust(80, b" ") + struct.pack("<I", 2) + facet * 2
    yield b"ascii", (b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1e0 -0\nendloop\n"
                     b"endfacet\nendsolid a\n")
    yield b"capitals", (b"solid a\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 0 0\nVERTEX 0 1e0 -0\n"
                        b"END LOOP\nENDFACET\nENDSOLID a\nmore")


def off():
    floats = b"".join(struct.pack(">3f", *p) for p in XYZ)
    faces = b"".join(struct.pack(">5i", 3, *t, 0) for t in TRIANGLES)
    yield b"ascii", b"OFF\n4 2 0\n" + b"".join(b"%g %g %g\n" % p for p in XYZ) + b"3 0 1 2\n4 0 1 2 3 255 0 0\n"
    yield b"colours", b"CNOFF 2 0 0\n0 0 0 0 0 1 255 0 0\n# none\n1 0 0 0 0 1 0 0.5 0\n"
    yield b"four", b"4OFF\n1 0 0\n1 2 3 2\n"
    yield b"binary", b"OFF BINARY\n" + struct.pack(">3i", 4, 2, 0) + floats + faces
    little = b"".join(struct.pack("<3f", *p) for p in XYZ) + b"".join(struct.pack("<4i", 3, *t) for t in TRIANGLES)
    yield b"little", b"OFF BINARY\n" + struct.pack("<3i", 4, 2, 0) + little
    yield b"glued", b"OFF3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"


def vtk():
    for form in ("ASCII", "BINARY"):
        def values(letter, numbers, form=form):
            packed = struct.pack(f">{len(numbers)}{letter}", *numbers)
            return (packed if form == "BINARY" else " ".join(map(str, numbers)).encode()) + b"\n"
        head = f"# vtk DataFile Version %s\nseed\n{form}\nDATASET POLYDATA\nPOINTS 4 float\n"
        points = values("f", [x for p in XYZ for x in p])
        data = (b"CELL_DATA 2\nSCALARS q int\nLOOKUP_TABLE default\n" + values("i", [1, 2]) +
                b"POINT_DATA 4\nNORMALS n double\n" + values("d", range(12)) + b"FIELD f 1\na%20b 2 4 short\n" +
                values("h", range(8)) + b"METADATA\nINFORMATION 0\n\n")
        yield form.lower().encode(), ((head % "3.0").encode() + points + b"POLYGONS 2 8\n" +
                                      values("i", [3, 0, 2, 1, 3, 0, 1, 3]) + data)
        yield form.lower().encode() + b"5", ((head % "5.1").encode() + points +
                                             b"TRIANGLE_STRIPS 2 4\nOFFSETS vtktypeint64\n" + values("q", [0, 4]) +
                                             b"CONNECTIVITY vtktypeint64\n" + values("q", [0, 1, 2, 3]) + data)


def npy(kind, shape, values):
    """kind: numpy's name of the type and struct's."""
    descr, letter = kind
    header = f"{{'descr': '{descr}', 'fortran_order': False, 'shape': ({', '.join(map(str, shape))},), }}\n".encode()
    data = values if letter == "s" else struct.pack(f"<{len(values)}{letter}", *values)
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header + data


FLOAT, INT, LONG, BYTE = ("<f8", "d"), ("<i4", "i"), ("<i8", "q"), ("|u1", "B")


def folder(pieces):
    """Numbers of files, see fuzz_laplacian.cpp, and their contents."""
    return b"".join(struct.pack("<BH", number, len(content)) + content for number, content in pieces)


def laplacian():
    """A right triangle and a point that is nowhere."""
    names = ["L.npz", "M.npy", "status.npy", "representative.npy", "boundary.npy", "frames.npy",
             "cover.npz", "measured_positions.npy", "noise.npy", "component_edges.npy"]
    files = ", ".join(f'"{name}"' for name in names)
    frames = [1, 0, 0, 0, 1, 0, 0, 0, 1] * 4
    legs = [1, 2 ** 0.5, 1, 1, 2 ** 0.5, 1]
    for sign in ("psd", "igl"):
        report = f'{{"write_options": {{"files": [{files}], "sign": "{sign}"}}, "report": {{"points": 4, "area": 0.5}}}}'
        flip = 1 if sign == "psd" else -1
        yield sign.encode(), folder([
            (0, report.encode()), (1, npy(FLOAT, [4], [1 / 6] * 3 + [0])), (2, npy(BYTE, [4], [0, 0, 0, 1])),
            (3, npy(INT, [4], range(4))), (4, npy(BYTE, [4], [1, 1, 1, 0])), (5, npy(FLOAT, [4, 3, 3], frames)),
            (8, npy(("|S3", "s"), [1], b"csc")), (9, npy(LONG, [2], [4, 4])), (10, npy(INT, [5], [0, 3, 5, 7, 7])),
            (11, npy(INT, [7], [0, 1, 2, 0, 1, 0, 2])),
            (12, npy(FLOAT, [7], [flip * x for x in (1, -0.5, -0.5, -0.5, 0.5, -0.5, 0.5)])),
            (13, npy(INT, [2, 3], [0, 1, 2, 0, 2, 1])), (14, npy(INT, [2, 3], [5, 4, 3, 2, 1, 0])),
            (15, npy(FLOAT, [2, 3], legs)),
            (16, npy(FLOAT, [4, 3], [0, 0, 0, 1, 0, 0, 0, 1, 0, 9, 9, 9])),
            (17, npy(FLOAT, [4], [0, 0.1, 0, 0])), (18, npy(FLOAT, [1, 3], [9, 1.1, 1.3]))])


SEEDS = {
    "laplacian": laplacian(),
    "pcd": pcd(),
    "ply": ply(),
    "las": ((b"1.%d-%d" % (minor, form), las(minor, form)) for minor, form in
            [(2, 0), (2, 1), (2, 2), (2, 3), (3, 4), (3, 5), (4, 6), (4, 7), (4, 8), (4, 9), (4, 10)]),
    "stl": stl(),
    "npy": [(b"double", npy(FLOAT, [2, 3], range(6))), (b"float", npy(("<f4", "f"), [3, 3], range(9))),
            (b"columns", npy(FLOAT, [2, 3], range(6)).replace(b"False", b"True ")),
            (b"image", npy(("<i2", "h"), [2, 2, 3], range(12))), (b"half", npy(("<f2", "e"), [4, 4], range(16))),
            (b"structures", npy(("<f4", "s"), [2], bytes(44)).replace(
                b"'<f4'", b"[('xyz', '<f4', (3,)), ('', '|V4'), (('t', 'i'), '>u2'), ('rgb', '|u1', (4,))]"))],
    "vtk": vtk(),
    "off": off(),
    "obj": [(b"mesh", b"# seed\nv 0 0 0 1 0.5 0\nv 1 0 0 1 0 0\nv 0 1 0 0 0 0\nvn 0 0 1\nvt 0 0\nf 1/1/1 2//2 -1 \\\n 3\n"),
            (b"cloud", b"v 0 0 0\nvn 0 0 1\nv 1 0 0 1\nvn 0 0 1\n")],
    "xyz": [(b"plain", b"3\n0 0 0\n1,0,0;\n+0.5e-3 nan 1.#QNAN\n"), (b"named", b"x,y,z,red\n0,0,0,1\n1,2,3,4 # end\n"),
            (b"commented", b"//X,Y,Z,\"R\",G,B\n2\n1,2,3,4,5,6\n1,2,3,4,5,6\n1\n7,8,9,1,1,1\nmore"),
            (b"index", b",x,y,z\n0,1,2,3\n"), (b"quoted", b"\"x\" \"y\" \"z\"\n\"1\" 1 2 3\n"),
            (b"normals", b"0 0 0 0 0 1 9\n1 0 0 0 0.6 0.8 7\n// done\n")],
}

if __name__ == "__main__":
    root = pathlib.Path(sys.argv[1])
    everything = root / "content"
    everything.mkdir(parents=True, exist_ok=True)
    for form, seeds in SEEDS.items():
        (root / form).mkdir(parents=True, exist_ok=True)
        for name, data in seeds:
            (root / form / name.decode()).write_bytes(data)
            if form == "laplacian":  # no file of points
                continue
            (everything / f"{form}-{name.decode()}").write_bytes(data)
