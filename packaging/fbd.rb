# SPDX-License-Identifier: GPL-3.0-or-later
class Fbd < Formula
  desc "Free-body diagrams that run"
  url "@FBD_SOURCE_URL@"
  version "0.1.0"
  sha256 "@FBD_SOURCE_SHA256@"
  license "GPL-3.0-or-later"

  depends_on "meson" => :build
  depends_on "ninja" => :build
  depends_on "pkg-config" => :build
  depends_on "gsl"
  depends_on "libyaml"
  depends_on :linux # docs/building.md: macOS

  def install
    system "meson", "setup", "build", "-Dstrip=true", "-Dmpi=disabled", "-Dtests=disabled", "-Dfmi=disabled",
           "-Dstatic-programs=disabled", *std_meson_args
    system "ninja", "-C", "build", "programs"
    system "meson", "install", "-C", "build", "--no-rebuild"
  end

  test do
    system bin/"fbd-run", share/"fbd/models/kinetics/incline.yaml"
  end
end
