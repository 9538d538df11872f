"""How the compared methods look in every figure: one colour and dash each; ours is the heavy line."""

import style

_LOOK = {  # method -> colour, dashes: solid with a Hessian, dashed without, dotted by local steps
    "core": (style.ESTIMATE, (None, None)),
    "projected_newton": ("#D55E00", (None, None)),
    "levenberg_marquardt": ("#009E73", (None, None)),
    "implicit_euler": ("#CC79A7", (None, None)),
    "backward_euler": ("#8C564B", (None, None)),
    "lbfgs": ("#E69F00", (4, 1.5)),
    "conjugate_gradients": ("#222222", (4, 1.5)),
    "explicit_dynamics": ("#56B4E9", (4, 1.5)),
    "dynamic_relaxation": ("#009E73", (4, 1.5)),
    "admm": ("#CC79A7", (1, 1.2)),
    "xpbd": ("#D55E00", (1, 1.2)),
}


def line(method):
    colour, dashes = _LOOK[method]
    ours = method == "core"
    return dict(color=colour, dashes=dashes, linewidth=1.8 if ours else 0.9,
                zorder=5 if ours else 3)
