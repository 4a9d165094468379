#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Diagrams of --svg by their options: worksheets, symbols, scales, statics, other formats; equations as LaTeX.
set -u
. "$FBD_SOURCE_ROOT/tests/cli/program.sh"
incline=$models/kinetics/incline.yaml
crank=$models/couplings/slider_crank.yaml
ladder=$models/statics/ladder.yaml

draw() { # draw MODEL ARGUMENT...: the diagram of the start in `out`
    model=$1
    shift
    run --quiet --equations --svg - "$@" "$model"
}

joined() { # joined NAME MODEL: the figure of the system of a model of the gallery in `out`
    check "$1" exits 0 draw "$models/$2.yaml" --system
}

lacks() { # lacks PATTERN FILE
    ! grep -qE -- "$1" "$2"
}

# ---- what is drawn
check 'a body is cut free' exits 0 draw "$incline"
check 'without the ground' lacks 'class="(ground|hatch)"' out
check '--supports' exits 0 draw "$incline" --supports
check 'draws it' says 'class="hatch"' out
check '--symbols' exits 0 draw "$incline" --symbols
index='<tspan class="index" dy=".286em">' back='</tspan><tspan dy="-.2em" xml:space="preserve">' nbsp=$(printf '\302\240')
for symbol in mg N "μ${index}k${back}N</tspan>" push; do
    check "labels an arrow $symbol" says ">$symbol</text>" out
done
check 'without values' lacks 'class="label middle"[^<]*> *[a-z]* [0-9.]+ N<' out
check '--worksheet' exits 0 draw "$crank" --worksheet
check 'has no arrows' lacks 'class="arrow' out
check 'but bodies' says 'id="crank-outline"' out
check '--solution' exits 0 draw "$crank" --solution
check 'has symbols with their values' says ">R${index}2$back${nbsp}= 19.66 N, pin<" out
check 'and those of the opposite force' says ">R${index}2$back${nbsp}= 19.66 N, connecting_rod.pin<" out
check 'all bodies have one scale of forces' sh -c '[ "$(grep -o "forces: 10 mm = [^<]*" out | sort -u | wc -l)" -eq 1 ]'
check '--scale' exits 0 draw "$crank" --scale 12
check 'is that of every body' sh -c '[ "$(grep -c "forces: 10 mm = 12 N" out)" -eq 3 ]'
check 'with its unit' exits 0 draw "$crank" --scale '0.1 kN'
check 'it is that as well' says 'forces: 10 mm = 100 N<' out
check 'thousands have a prefix' exits 0 draw "$crank" --scale '30 kN'
check '(kN)' says 'forces: 10 mm = 30 kN<' out
check 'and in another system' exits 0 draw "$models/kinetics/drop_us.yaml" --scale '10 N'
check 'what it is there, 10/4.4482216152605 lbf' says 'forces: 10 mm = 2.2480[0-9]* lbf' out
check 'a body alone has the scale of the scene' exits 0 draw "$crank" --body piston
check 'as it has among the others' says 'forces: 10 mm = 8 N' out
foreign_rules() { # rules of the drawing's style that are not for drawings of ours alone
    sed -n '/<style/,/<\/style>/p' "$1" | grep -v '<style\|</style>\|^@media\|^}' | tr '}' '\n' | sed 's/{.*//' | tr ',' '\n' | grep -v '^$\|^\.fbd '
}
check 'inlined in a page the style says nothing about the rest of it' sh -c '[ -z "$1" ]' - "$(foreign_rules out)"

# ---- the system
check '--system' exits 0 draw "$crank" --system
check 'has the bodies joined' sh -c '[ "$(grep -c "id=\"system\"" out)" -eq 1 ] && [ "$(grep -c "class=\"outline\"" out)" -eq 3 ]'
check 'with their supports' says 'class="hatch"' out
cp out system.svg
check 'it is deterministic' exits 0 draw "$crank" --system
check '(the same bytes)' cmp -s out system.svg
check 'its applied forces have letters' exits 0 draw "$incline" --system
check '(push)' says '>push</text>' out
check 'without gravity and reactions' lacks 'class="(gravity|reaction)"|>mg<|>N<' out
joined 'a body on another' trees/stacked_blocks
check 'stands on top of it' says 'class="body" points="9,-19.5 -9,-19.5 -9,-6.5 9,-6.5"' out
joined 'bodies on two ropes' couplings/atwood
check 'do not overlap' says 'class="body" points="-1.056,' out
joined 'a track' tracks/loop_the_loop
check 'is drawn whole' sh -c '[ "$(grep -o "class=\"ground\".* y2=\"-50\"" out | wc -l)" -ge 1 ]'
joined 'a rope that a winch winds up' couplings/winch
check 'has a drum' says 'circle class="body" [^>]*r="4"' out
check 'and no wall' lacks 'class="hatch"' out
joined 'bodies on one ground' contact/dominoes
check 'have it hatched once' sh -c '[ "$(grep -c "class=\"hatch\"" out)" -eq 1 ]'
joined 'a slope under a ball' couplings/rolling_on_incline
check 'has its angle' says '>30°<' out
joined 'a truss' statics/truss
check 'stands on a pin' says 'polygon class="support"' out
check 'and a roller' says 'circle class="support"' out
check 'an applied moment' exits 0 draw "$crank" --system
check 'is an arc with its letter' sh -c 'grep -q "path class=\"shaft\"" out && grep -q ">drive<" out'
joined 'stairs' contact/stairs
# three floors and the two walls between them: no side between two of the polygons, and not their underside
check 'have the outline of their polygons together' sh -c '[ "$(grep -c "class=\"ground\"" out)" -eq 5 ]'
joined 'a table on a floor' contact/ball_off_a_table
check 'has three sides, and the floor is one' sh -c '[ "$(grep -c "class=\"ground\"" out)" -eq 4 ]'
joined 'a cam' couplings/cam_and_follower
check 'has its outline, of 240 points' sh -c '[ "$(grep "class=\"body\"" out | sed "s/.*points=//" | wc -w | sort -n | tail -n 1)" -ge 240 ]'
check 'and in the diagram of its forces' exits 0 draw "$models/couplings/cam_and_follower.yaml" --body cam
check '(its outline)' sh -c '[ "$(grep "class=\"body\"" out | wc -w)" -ge 240 ]'
check 'where the force of the follower acts' says 'face on cam: .*acts at \(0, 0\.05\) m' out
joined 'a rope round a bollard' couplings/capstan
check 'lies on it' says 'path class="rope" d="M[^"]* A' out
check 'and the bollard is hatched' says '<path class="hatch" d=" M' out
check 'its force on a block is at the rope' exits 0 draw "$models/couplings/capstan.yaml" --body hand
check '(in the middle)' says 'rope on hand: .*acts at \(-2, 0\.1\) m' out
joined 'a ratio' couplings/differential
check 'has its equation below' says '>gears: 2 cage.theta − left.theta − right.theta is constant<' out
joined 'a journal bearing' rotation/journal_bearing
check 'has a ring' says 'circle class="mass" [^>]*r="1.9"' out
check 'with the letter of its coefficient' says '>μ</text>' out
joined 'a horizontal plane' kinetics/puck
check 'has gravity into the paper' says '>⊗ g</text>' out
check 'and a patch of ground' says 'class="hatch"' out
check 'and in the diagram of forces' exits 0 draw "$models/kinetics/puck.yaml" --symbols
check 'the weight and the normal force' says '>⊗ mg, ⊙ N</text>' out
check 'but not on a worksheet' exits 0 draw "$models/kinetics/puck.yaml" --worksheet
check '(no weight)' lacks '⊗' out
joined 'letters with a number' trees/stacked_blocks
check 'have it as their index' says ">m${index}1</tspan></text>" out
joined 'a rod given by its ends' statics/cantilever
check 'has the letter of its length' says '>L = 2 m<' out
joined 'a belt' hard/stick_slip_belt
check 'has its speed' says ">v${index}b</tspan></text>" out
cat >slope.yaml <<'end'
fbd: 1
bodies:
  disc: {shape: disc, radius: 0.1 m, mass: 1 kg, motion: planar, initial: {x: -0.05 m, y: 0.0866025403784 m}, forces: [gravity]}
ground: {lines: {slope: {along: 30 deg}}}
couplings: [roll: {body: disc, on: slope, static: 0.4, surface_speed: 1.5 m/s}]
simulate: {until: 0.5 s}
end
sed 's/^ground:.*/  plank: {mass: 4 kg, motion: {slide: {along: 30 deg}}}/; s/on: slope/on: plank/' slope.yaml >plank.yaml
check 'a slope that runs' exits 0 draw slope.yaml --system
grep 'line class="axis"' out >arrow
check 'has one arrow' sh -c '[ "$(wc -l <arrow)" -eq 1 ]'
check 'a plank whose surface runs' exits 0 draw plank.yaml --system
check 'has the same arrow' sh -c 'grep -qxF -f arrow out'
joined 'a conveyor' contact/conveyor_belt
check 'has it under both bodies' sh -c '[ "$(grep -c ">s</text>" out)" -eq 2 ]'
joined 'a spring about an axis' rotation/torsional_pendulum
check 'has its stiffness' says '>k = 0.9 N·m/rad<' out
joined 'a plate' plane/plate_with_hole
check 'is behind its bearing and its angle' sh -c '[ "$(grep -n "plate-outline" out | cut -d: -f1)" -lt "$(grep -n "plate-fixtures" out | cut -d: -f1)" ]'
joined 'a plate by its corners' rotation/triangular_plate
check 'has its side' says '>b</text>' out
check 'and its height' says '>h</text>' out
joined 'an eccentric wheel' couplings/eccentric_wheel
check 'has its centre of mass' says '>G</text>' out
cat >stops.yaml <<'end'
fbd: 1
parameters: {a: 0.5 m}
bodies:
  cart: {shape: prism, mass: 2 kg, a: 0.3 m, b: 0.15 m, c: 0.1 m, motion: {slide: {min: -2*a, max: a}}, forces: [gravity, normal]}
  rod: {shape: rod, mass: 1 kg, from: [0, 0], to: [0, -0.4 m], motion: {pivot: {on: cart, min: -40 deg, max: 40 deg}}, forces: [gravity]}
simulate: {until: 1 s}
end
check 'stops' exits 0 draw stops.yaml --system
for text in 'x ≥ −1 m' 'x ≤ a' 'θ ≥ −40°' 'θ ≤ 40°' 'a = 0.5 m'; do
    check "have $text" says ">$text<" out
done
check '--system is no body alone' exits 2 draw "$crank" --system --body piston

all_drawn() { # the figure of every model, well formed
    mkdir figures && find "$models" -name '*.yaml' | sort >models.txt
    while read -r file; do
        run --quiet --equations --svg "figures/$(basename "$file" .yaml).svg" --system "$file" || {
            echo "# $file"
            return 1
        }
    done <models.txt
    python3 -c 'import sys, xml.dom.minidom as x; [x.parse(name) for name in sys.argv[1:]]' figures/*.svg
}
check 'every model has a figure of its system' all_drawn

# ---- gears without a shape: the force stands at the mesh, one radius from the axis
check 'gears' exits 0 draw "$models/couplings/gear_pair.yaml"
check 'are drawn as wheels' sh -c '[ "$(grep -c "circle class=\"body\"" out)" -eq 2 ]'
check 'with the force at the mesh' says '<title>mesh on pinion: .*acts at \(0.05, 0\) m' out

# ---- at rest
check '--static --svg' exits 0 run --quiet --static --svg ladder.svg "$ladder"
check 'has the reactions of the statics' says '<title>normal on foot: \(0, 1015.82' ladder.svg

# ---- mistakes
check '--worksheet has no arrows to label' exits 2 draw "$crank" --worksheet --symbols
check '--symbols without --svg: the equations' exits 0 run --symbols "$crank"
check 'with reactions by their letters' says '^    m_3 v_dot = -R_3x$' out
check 'and the acceleration of G' says '^    a_Gx = a_Ox - L_2 \(angle_ddot sin\(angle\) \+ angle_dot\^2 cos\(angle\)\)$' out
check 'no page has arrows to label' exits 2 run --symbols --html crank.html "$crank"
check 'and for eigenvalues' exits 2 run --linearize --svg - --symbols "$models/vibration/damped_oscillator.yaml"
check 'a file that promises another picture is 2' exits 2 run --quiet --svg crank.jpg "$crank"
check 'and none is written' test ! -e crank.jpg
for scale in 0 '0 N' '-2 N' '5 kg' '5 Nn' five ''; do
    check "\`$scale\` is no scale" exits 2 draw "$crank" --scale "$scale"
    check '(it is said what is)' says '\-\-scale wants a force above 0, as `5` or `2 kN`' err
done
check 'of another dimension it is said which' exits 2 draw "$crank" --scale '5 kg'
check '(which)' says 'needs force \[N\], not mass \[kg\]' err
check 'it goes with diagrams' exits 2 run --quiet --scale '5 N' "$crank"
check '--latex goes with --equations' exits 2 run --latex "$crank"

# ---- other formats
check 'without a converter .pdf is 2' exits 2 sh -c 'PATH=/nowhere "$0" --quiet --svg none.pdf "$1" 2>err' "$FBD_RUN" "$incline"
check 'and says which one is missing' says 'rsvg-convert \(Debian: librsvg2-bin\)' err
check 'and nothing is written' test ! -e none.pdf
if command -v rsvg-convert >/dev/null || command -v inkscape >/dev/null; then
    check '.pdf' exits 0 run --quiet --svg sheet.pdf "$crank"
    check 'is one' says '^%PDF' sheet.pdf
    check '.png' exits 0 run --quiet --svg sheet.png "$crank"
    check 'is one' says 'PNG' sheet.png
    check 'of eigenvalues as well' exits 0 run --quiet --linearize --svg plane.png "$models/vibration/damped_oscillator.yaml"
else
    echo '# neither rsvg-convert nor inkscape is installed: other formats are left out'
fi

# ---- components of a slide on a slanted one: its line is at 60 deg to the ground, W sin(60 deg) along it
cat >carried.yaml <<'END'
fbd: 1
bodies:
  wedge: {mass: 2 kg, motion: {slide: {along: 30 deg}}, forces: [gravity]}
  block: {mass: 10 kg, motion: {slide: {on: wedge, along: 30 deg}}, forces: [gravity]}
simulate: {until: 1 s}
END
check '--svg --components on a body that is carried' exits 0 run --svg - --components carried.yaml
check 'are along its line in the world' says "gravity${index}x$back${nbsp}84\.96 N" out
check 'and across it' says "gravity${index}n$back${nbsp}49\.05 N" out

# ---- LaTeX
check '--equations --latex' exits 0 run --equations --latex "$incline"
check 'has the symbols of the file' says '^m\\,\\dot\{v\} &= -m\\,g\\,\\sin \(\\phi \) - \\mu _\{k\}\\,N \+ \\mathit\{push\} ' out
check 'and the numbers of the state' says '&= -9.81 - 8.49571 \+ 5\\,\\mathrm\{N\}' out
check 'of bodies cut free' exits 0 run --equations --components --latex "$crank"
check 'a force and its opposite have one symbol' sh -c 'grep -q "R_{1x} - R_{2x}" out && grep -q "R_{3x} + R_{2x}" out'
finish
