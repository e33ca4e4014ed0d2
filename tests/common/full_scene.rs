//! A scene with every kind of thing that a scene can contain.

/// Every shape, material, light, transform step, spectrum and index of refraction, each at least once.
pub const FULL: &str = r##"{
  "$schema": "https://example.org/abbe.schema.json",
  "abbe": 1,
  "name": "everything",
  "comment": "comments may stand in any object",
  "camera": { "type": "perspective", "name": "main", "comment": "x", "from": [0, 1, 5], "to": [0, 0, 0], "up": [0, 0, -1],
              "fov_degrees": 39.5, "fov_axis": "y", "aperture_radius": 0.01, "focus_distance": 4 },
  "film": { "width": 512, "height": 256, "filter": { "type": "blackman-harris", "comment": "x" } },
  "render": { "samples_per_pixel": 256, "max_depth": 7, "seed": 9007199254740992, "integrator": "merge", "comment": "x" },
  "spectra": {
    "comment": "x",
    "red": { "wavelengths_nm": [380, 500, 600, 780], "values": [0.04, 0.05, 0.4, 0.64], "comment": "x" },
    "dark red": { "name": "red", "scale": 0.5 },
    "alias": "dark red",
    "measured": { "file": "data/red.csv", "scale": 2 },
    "half": 0.5
  },
  "materials": {
    "comment": "x",
    "floor": { "type": "diffuse", "reflectance": { "rgb": [0.8, 0.8, 0.8] }, "two_sided": false, "name": "floor", "comment": "x" },
    "mirror": { "type": "mirror", "reflectance": "alias" },
    "gold": { "type": "conductor", "metal": "Au", "roughness": [0, 0] },
    "steel": { "type": "conductor", "eta": 2.5, "k": { "wavelengths_nm": [400, 700], "values": [2.5, 3.5] }, "roughness": 0 },
    "flint": { "type": "dielectric", "ior": { "glass": "N-SF11", "extrapolate": "hold" }, "priority": -2,
               "absorption_per_m": { "name": "half", "scale": 4 } },
    "crown": { "type": "dielectric", "ior": { "sellmeier": { "b": [1.03961212, 0.231792344], "c_um2": [0.00600069867, 0.0200179144] } } },
    "cauchy": { "type": "dielectric", "ior": { "cauchy_um": [1.5, 0.004] } },
    "abbe": { "type": "dielectric", "ior": { "nd": 1.5168, "vd": 64.17 } },
    "table": { "type": "dielectric", "ior": { "wavelengths_nm": [350, 850], "values": [1.53, 1.51] } },
    "file": { "type": "dielectric", "ior": { "file": "water.yml" } },
    "plain": { "type": "dielectric", "ior": 1.33, "roughness": 0 }
  },
  "objects": [
    { "shape": { "type": "sphere", "center": [0, 1, 0], "radius": 1, "name": "ball", "comment": "x" }, "material": "flint", "name": "ball",
      "transform": [ { "translate": [1, 0, 0], "comment": "x" }, { "rotate_degrees": 30, "axis": [0, 2, 0] }, { "scale": 2 },
                     { "scale": [1, -1, 1] }, { "matrix": [1, 0, 0, 5, 0, 1, 0, 6, 0, 0, 1, 7, 0, 0, 0, 1] } ] },
    { "shape": { "type": "quad", "origin": [-5, 0, -5], "u": [0, 0, 10], "v": [10, 0, 0] }, "material": "floor" },
    { "shape": { "type": "disk", "center": [0, 4, 0], "normal": [0, -2, 0], "radius": 0.5 }, "emission_two_sided": true,
      "emission": { "illuminant": "D65", "scale": 20 } },
    { "shape": { "type": "triangles", "positions": [0, 0, 0, 1, 0, 0, 0, 1, 0], "indices": [0, 1, 2],
                 "normals": [0, 0, 1, 0, 0, 1, 0, 0, 1], "uvs": [0, 0, 1, 0, 0, 1] }, "material": "mirror" },
    { "shape": { "type": "mesh", "file": "meshes/bunny.PLY" }, "material": "gold" },
    { "shape": { "type": "prism", "apex_degrees": 60, "side": 1, "length": 2 }, "material": "crown" },
    { "shape": { "type": "brilliant", "radius": 1 }, "material": "cauchy" },
    { "shape": { "type": "lens", "radii": [0.5, null], "thickness": 0.1, "diameter": 0.4 }, "material": "abbe" },
    { "shape": { "type": "lens", "radii": [0.5, 0.5], "thickness": 1, "diameter": 1 }, "material": "table" },
    { "shape": { "type": "implicit", "surface": "torus", "major_radius": 1, "minor_radius": 0.3 }, "material": "file" },
    { "shape": { "type": "implicit", "surface": "superquadric", "radii": [1, 2, 3], "exponent_y": 0.5 }, "material": "plain" },
    { "shape": { "type": "implicit", "surface": "gyroid", "period": 1, "thickness": 0.1, "radius": 2 }, "material": "steel" },
    { "shape": { "type": "implicit", "surface": "smooth-union", "centers": [[0, 0, 0], [1, 0, 0]], "radii": [1, 0.5], "blend": 0.2 }, "material": "floor" },
    { "shape": { "type": "implicit", "surface": "tanglecube", "size": 0.5, "comment": "x" }, "material": "floor" },
    { "shape": { "type": "box", "min": [0, 0, 0], "max": [1, 2, 3] }, "material": "floor" },
    { "shape": { "type": "cylinder", "radius": 1, "height": 2, "open": true }, "material": "floor" }
  ],
  "lights": [
    { "type": "point", "position": [0, 3, 0], "intensity": { "blackbody_kelvin": 5600, "normalize": false }, "name": "lamp" },
    { "type": "spot", "position": [0, 3, 0], "direction": [0, -1, 0], "intensity": { "rgb": [9, 1, 1], "space": "rec2020" },
      "inner_degrees": 10, "outer_degrees": 20 },
    { "type": "directional", "direction": [0, -1, 0], "irradiance": 1, "angular_diameter_degrees": 0.53 },
    { "type": "beam", "origin": [0, 0, 1], "direction": [0, 0, -1], "radius": 0.001, "power": { "line_nm": 589.3, "fwhm_nm": 0.1 } }
  ],
  "environment": { "radiance": "measured", "name": "sky" },
  "develop": { "exposure_ev": -1.5, "tonemap": "reinhard" }
}"##;
