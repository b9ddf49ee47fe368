"""Writes src/scene/height_map/epsg/table.rs from the EPSG register.

    pip install pyproj==3.7.2  # brings the register as a database, proj.db
    python3 src/scene/height_map/epsg/table.py > src/scene/height_map/epsg/table.rs
"""

import os
import sqlite3

import pyproj

register = sqlite3.connect(os.path.join(pyproj.datadir.get_data_dir(), "proj.db"))
version = register.execute("select value from metadata where key = 'EPSG.VERSION'").fetchone()[0]

AXIS = """
    join axis a on a.coordinate_system_auth_name = c.coordinate_system_auth_name
        and a.coordinate_system_code = c.coordinate_system_code and a.coordinate_system_order = 1
    where c.auth_name = 'EPSG' order by c.code
"""

# Methods whose lengths may be off by more than a few per mille, by the name that notes give them.
DISTORTED = {
    9822: "Albers equal-area",
    9820: "Lambert azimuthal equal-area",
    1027: "Lambert azimuthal equal-area",
    9829: "polar stereographic",
    9810: "polar stereographic",
    9830: "polar stereographic",
    1125: "azimuthal equidistant",
    9832: "azimuthal equidistant",
    9818: "polyconic",
    1078: "Equal Earth",
    9834: "cylindrical equal-area",
    9835: "cylindrical equal-area",
    9828: "Bonne",
}
MERCATOR = {9804: "Mercator", 9805: "Mercator", 9841: "SphericalMercator", 1024: "SphericalMercator"}
EQUIRECTANGULAR = {9823, 1028, 1029, 9842}


def runs(codes, value_of):
    """Ranges of codes of one value; a range spans codes that are not given at all."""
    out = []
    for code in sorted(codes):
        value = value_of(code)
        if out and out[-1][2] == value:
            out[-1][1] = code
        else:
            out.append([code, code, value])
    return [run for run in out if run[2] is not None]


def rust(name, kind, doc, lines):
    print(f"\n/// {doc}")
    print("#[rustfmt::skip]")
    print(f"pub(super) const {name}: &[{kind}] = &[")
    line = "   "
    for item in lines:
        if len(line) + len(item) > 96:
            print(line)
            line = "   "
        line += f" {item},"
    print(line)
    print("];")


print(f"""//! Units and projections of the EPSG register, {version}; written by `table.py` beside this file.

use crate::scene::height_map::projection::Method;""")

units = register.execute(
    "select code, conv_factor from unit_of_measure where auth_name = 'EPSG' and type = 'length' and conv_factor > 0"
)
# What lies below 9000 but millimetre and centimetre is a unit of speed.
lengths = {int(code): factor for code, factor in units if int(code) > 9000 or code in (1025, 1033)}
rust("LENGTHS", "(u16, f64)", "Codes of units of length and the metres of one.",
     [f"({code}, {factor!r})" for code, factor in sorted(lengths.items())])

projected = {
    int(code): (int(unit), int(method) if method else None, conversion)
    for code, unit, method, conversion in register.execute(
        f"""select c.code, a.uom_code, v.method_code, c.conversion_code from projected_crs c
        left join conversion_table v on v.auth_name = c.conversion_auth_name
            and v.code = c.conversion_code {AXIS}"""
    )
    if int(code) < 32767
}
rust("PROJECTED_UNITS", "(u16, u16, u16)",
     "Projected systems that do not count metres: first and last code, code of the unit.",
     [str(tuple(run)) for run in runs(projected, lambda c: None if projected[c][0] == 9001 else projected[c][0])])


def parameter(conversion, code):
    row = register.execute(
        """select param1_code, param1_value, param2_code, param2_value, param3_code, param3_value,
           param4_code, param4_value, param5_code, param5_value from conversion_table
           where auth_name = 'EPSG' and code = ?""", (conversion,)).fetchone()
    return {int(c): v for c, v in zip(row[::2], row[1::2]) if c is not None}.get(code)


def distorted(code):
    """The name of a projection whose lengths are off; conics are between parallels far apart."""
    unit, method, conversion = projected[code]
    if method == 9802 and abs(parameter(conversion, 8823) - parameter(conversion, 8824)) > 10:
        return "Lambert conic of wide parallels"
    return DISTORTED.get(method)


rust("DISTORTED", "(u16, u16, &str)",
     "Projected systems whose lengths are not lengths on the ground: first and last code, projection.",
     [f'({a}, {b}, "{m}")' for a, b, m in runs(projected, distorted)])

cylindrical = []
for code, (unit, method, conversion) in sorted(projected.items()):
    if method not in MERCATOR and method not in EQUIRECTANGULAR:
        continue
    north = parameter(conversion, 8807) or 0.0
    scale = parameter(conversion, 8805)
    standard = parameter(conversion, 8823)
    if parameter(conversion, 8801) not in (None, 0.0):
        continue
    assert unit == 9001
    name = MERCATOR.get(method, "Equirectangular")
    cylindrical.append(f"({code}, Method::{name}, {scale if scale is not None else 1.0!r}, {standard or 0.0!r}, {north!r})")
rust("CYLINDRICAL", "(u16, Method, f64, f64, f64)",
     "Cylindrical projections: code, method, scale at the equator, standard parallel in degrees, false northing.",
     cylindrical)

vertical = {
    int(code): (int(unit), way)
    for code, unit, way in register.execute(f"select c.code, a.uom_code, a.orientation from vertical_crs c {AXIS}")
    if int(code) < 32767
}
rust("VERTICAL_UNITS", "(u16, u16)", "Vertical systems that do not count metres, and their units.",
     [f"({code}, {unit})" for code, (unit, _) in vertical.items() if unit != 9001])
rust("VERTICAL", "(u16, u16)", "Vertical systems: first and last code.",
     [f"({a}, {b})" for a, b, _ in runs(sorted(set(vertical) | set(projected)), lambda c: (c in vertical) or None)])
rust("DEPTHS", "(u16, u16)", "Vertical systems that count downwards: first and last code.",
     [f"({a}, {b})" for a, b, _ in runs(vertical, lambda c: (vertical[c][1] == "down") or None)])
geographic = {
    int(code): int(unit)
    for code, unit in register.execute(f"select c.code, a.uom_code from geodetic_crs c {AXIS}".replace(
        "where c.auth", "where c.type like 'geographic%' and c.auth"))
    if int(code) < 32767
}
rust("GEOGRAPHIC", "(u16, u16)", "Geographic systems: first and last code.",
     [f"({a}, {b})" for a, b, _ in runs(sorted(set(geographic) | set(projected) | set(vertical)), lambda c: (c in geographic) or None)])
solid = {
    int(code) for (code,) in register.execute(
        "select code from geodetic_crs where auth_name = 'EPSG' and type = 'geographic 3D'")
}
rust("SOLID", "(u16, u16)", "Geographic systems with heights, in metres: first and last code.",
     [f"({a}, {b})" for a, b, _ in runs(sorted(set(geographic) | set(projected) | set(vertical)), lambda c: (c in solid) or None)])
rust("GRADS", "u16", "Geographic systems that count grads.",
     [str(code) for code, unit in geographic.items() if unit == 9105])
