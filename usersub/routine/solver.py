# SPDX-License-Identifier: MIT
"""Names that belong to the commercial solver: its user subroutines, and what only it provides."""

from __future__ import annotations

#: User subroutines of the commercial solver that may stand in the same file as a routine.
ENTRIES = frozenset(
    """
    uel uelmat uexternaldb vexternaldb umat umatht uhyper uhard umullins creep usdfld sdvini
    sigini uvarm urdfil ufield vufield uamp vuamp dload utracload disp film dflux hetval uinter
    gapcon gapelectr umeshmotion uexpan utemp upress udecurrent udemagnetic flow dflow upsd uwave
    urcoef uel_th voids mpc rsurfu harden hardini vumat vumatht vuhard vusdfld vuel vuinter
    vuinteraction vuexpan vuequivalent vufluidexch vdisp vdload vdflux vfabric vuviscosity vwave
    vumullins uconstraint usuperelas uanisohyper_inv uanisohyper_strain ucreepnetwork ucorr
    uthermal
    """.split()
)

#: Utility routines that need the solver's model or results. A call of one ends the call of the
#: routine with a message; a file that only mentions them loads.
UTILITIES = frozenset(
    """
    getvrm vgetvrm getvrn getvrmavgatnode getnodetoelemconn getinternal vgetinternal
    getelemnumberuser vgetelemnumberuser getnodenumberuser sinv sprinc sprind rotsig vsprinc vsprind
    igetsensorid ivgetsensorid getsensorvalue vgetsensorvalue posfil dbfile dbfilw getwave
    getwavevel getwindvel mat_getvrm settablecollection getparametertable getpropertytable
    queryparametertable querypropertytable getparamvalue getmatprops getorientation
    getactiveelements gettimes getelemrotation
    """.split()
)


def plain(symbol: str) -> str:
    """`getvrm_` -> `getvrm`."""
    return symbol.lower().removesuffix("_")


def is_utility(symbol: str) -> bool:
    """Whether an external name is that of a utility routine which only the solver has."""
    return symbol.endswith("_") and plain(symbol) in UTILITIES
