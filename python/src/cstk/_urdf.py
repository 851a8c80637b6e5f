"""Options for reading URDF, SRDF and meshes, with all that C reads through their pointers."""

from __future__ import annotations

import os
from typing import Any, List, Mapping, Optional, Sequence, Tuple, Union

from numpy.typing import ArrayLike

from ._arrays import file_name, index, pose, text
from ._native import ffi
from ._options import options
from .enums import JointKind, MeshForm, UrdfGeometry
from .hierarchy import HierarchyOptions, hierarchy_options


FolderOrFolders = Union["os.PathLike[str]", str, Sequence[Union["os.PathLike[str]", str]]]
"""Folders, or one."""


def urdf_options(
    *,
    geometry: UrdfGeometry = UrdfGeometry.COLLISION,
    base: JointKind = JointKind.FIXED,
    parent: int = -1,
    sides: int = 0,
    at: Optional[ArrayLike] = None,
    prefix: Optional[str] = None,
    package_paths: FolderOrFolders = (),
    hierarchy: Optional[HierarchyOptions] = None,
    cache_folder: "os.PathLike[str] | str | None" = None,
    mesh_form: MeshForm = MeshForm.SURFACE,
    link_forms: Optional[Mapping[str, MeshForm]] = None,
) -> Tuple[Any, List[Any]]:
    """The structure of C, and what must outlive it."""
    if isinstance(package_paths, Mapping):
        raise TypeError("package_paths holds folders that packages lie in, not packages by name: give the parents of the mapping's folders")
    given_folders = [package_paths] if isinstance(package_paths, (str, bytes, os.PathLike)) else package_paths
    folders = [ffi.new("char[]", file_name("package_paths", folder)) for folder in given_folders]
    folder_list = ffi.new("char *[]", folders)
    prefix_text = None if prefix is None else ffi.new("char[]", text("prefix", prefix))
    cache = None if cache_folder is None else ffi.new("char[]", file_name("cache_folder", cache_folder))
    tree = hierarchy_options(hierarchy)
    named = dict(link_forms or {})
    links = [ffi.new("char[]", text("link_forms", link)) for link in named]
    forms = [{"link": link, "form": MeshForm(form)} for link, form in zip(links, named.values())]
    form_list = ffi.new("cstk_link_mesh_form[]", forms)
    given = options(
        "urdf_options",
        geometry=UrdfGeometry(geometry),
        base=JointKind(base),
        parent=parent,
        sides=index("sides", sides),
        at=None if at is None else pose("at", at).ravel().tolist(),
        prefix=prefix_text,
        package_paths=folder_list,
        package_path_count=len(folders),
        hierarchy=tree,
        cache_folder=cache,
        mesh_form=MeshForm(mesh_form),
        link_forms=form_list if forms else None,
        link_form_count=len(forms),
    )
    return given, [folders, folder_list, prefix_text, cache, tree, links, form_list]


def srdf_options(prefix: Optional[str], skip_unknown: bool) -> Tuple[Any, Any]:
    """The structure of C, and what must outlive it."""
    prefix_text = None if prefix is None else ffi.new("char[]", text("prefix", prefix))
    return options("srdf_options", prefix=prefix_text, skip_unknown=bool(skip_unknown)), prefix_text
