# SPDX-License-Identifier: GPL-3.0-or-later
{ pkgs ? import <nixpkgs> { } }:
pkgs.stdenv.mkDerivation {
  pname = "fbd";
  version = "0.1.0";
  src = pkgs.fetchurl {
    url = "@FBD_SOURCE_URL@";
    sha256 = "@FBD_SOURCE_SHA256@";
  };
  nativeBuildInputs = [ pkgs.meson pkgs.ninja pkgs.pkg-config pkgs.python3 ];
  buildInputs = [ pkgs.gsl pkgs.libyaml ];
  postPatch = "patchShebangs lib docs";
  mesonFlags = [ "-Dmpi=disabled" "-Dtests=disabled" "-Dfmi=disabled" "-Dstatic-programs=disabled" ];
  meta = {
    description = "Free-body diagrams that run";
    license = pkgs.lib.licenses.gpl3Plus;
    platforms = pkgs.lib.platforms.linux;
  };
}
