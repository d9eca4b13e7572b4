"""Which options of the command line are keywords of the functions. Imports nothing, so that the
script that writes the type stubs can use it, too."""

# Options that concern files of meshes, the terminal or other processes, and have no meaning for a
# function on arrays.
NOT_KEYWORDS = frozenset({
    "format", "input-format", "precision", "checkpoint", "engine", "json", "quiet", "verbose",
    "dump-config", "help", "json-usage"})
MANY_FILES = "Many files"

# Options whose value may be an array with one number for each vertex.
PER_VERTEX = frozenset({"weights", "h0", "mask", "region"})

# The types of keywords that take more in Python than a word of the command line.
KINDS = {
    **dict.fromkeys(("weights", "mask", "region"), "array_like of shape (n,) or str"),
    "h0": "float, array_like of shape (n,), or str",
    "fix": "array_like",
    "cutoff": "float or str",
    "only": "int or sequence of int",
    "bridge": "pair of int, or sequence of pairs",
    "anisotropy": "sequence of four float",
    "torus": "pair of float",
    "center": "sequence of three float",
    "move": "sequence of three float",
    "rim_smooth": "int or 'auto'",
    "report": "str, path-like, or sequence of them",
    "picture": "str or path-like",
    "memory": "int or str",
    "sphere": "float or 'fit'",
}

# The keywords of `smooth` that concern single steps of the published scheme, for Flow.
OF_STEPS = ("cutoff", "steps", "time_step", "laplacian", "h0", "anisotropy", "mass", "no_mass",
            "metric", "newton_iterations", "keep_sharp", "weights", "keep_volume", "keep_area",
            "boundary", "fix", "mask", "max_move", "solver", "solver_tolerance", "memory", "threads")

# What these keywords mean for arrays, where the help of the program speaks of files.
ON_ARRAYS = {
    "fix": "Vertices that do not move: flags (n,), or numbers counted from 0.",
    "mask": "The vertices that move: flags (n,) or numbers; with a Mesh also the name of an OBJ group, object or "
            "material, or of a PLY property.",
    "weights": "A factor for the cut-off at each vertex: 0 fixes the vertex, 1 smooths it fully.",
    "region": "The vertices to fair again (flags or numbers), instead of filling holes; with a Mesh also the "
              "name of a group or property; '@all' is all but the boundaries.",
    "dry_run": "Only forecast time and memory; the positions stay.",
    "strict": "Raise an exception if the mesh has defects or the result is not what was asked for, "
              "instead of warning.",
    "overwrite": "Replace a report or picture that exists.",
    "report": "Also write the report to this file, or these files: .html is a page that shows the "
              "mesh, .json holds all figures, .csv a table.",
}


def is_keyword(option):
    """Whether a row of the program's list of options is a keyword."""
    return option["name"].lstrip("-") not in NOT_KEYWORDS and option["group"] != MANY_FILES


def keywords(options):
    """{keyword: row} of the options of a command."""
    return {option["name"].lstrip("-").replace("-", "_"): option for option in options
            if is_keyword(option)}
