# Shares of components in a variance: $shares, for each of `count` samples rows (place from the top,
# share / %, number of the component); `components` is how many places there are.
set terminal svg size 720,380 font "sans-serif,13" background "#ffffff"
# Components by their numbers: those of SetupQuantity, then those of UncertaintyComponent.
array name[19] = ["angle of incidence", "angle of the receptor", "source image, in plane", \
  "source image, perpendicular", "source image, diameter", "receptor, in plane", \
  "receptor, perpendicular", "receptor, diameter", "polarization", "spectral mismatch", \
  "index of the reference glass", "value of the working standard", "linearity", \
  "zero and stray light", "drift", "temperature", "resolution", "repeatability", "another one"]
set xlabel "share of the variance of a reading / %"
set xrange [x_low:x_high]
set yrange [components + 0.6:0.4]
set ytics scale 0
set grid xtics
set key at graph 0.98,0.06 right bottom
half = 0.36 / count
at(i) = 2 * half * (i - 0.5 - 0.5 * count)
plot NaN notitle, \
     $shares index 0 using (0):1:yticlabels(name[int($3)]) with dots lc rgb "#ffffff" notitle, \
     for [i = 1:count] $shares index i - 1 \
       using (0.5 * $2):($1 + at(i)):(0):2:($1 + at(i) - half):($1 + at(i) + half) \
       with boxxyerror lw 1 dt solid fc rgb (i == 1 ? "#005a9c" : "#b34700") \
       fs pattern (i == 1 ? 3 : 5) border lc rgb "#222222" title sprintf("%d", i), \
     for [i = 1:count] $shares index i - 1 \
       using ($2 > 0 ? $2 : 0):($1 + at(i)):(sprintf("%.1f", $2)) \
       with labels left offset 0.6,0 font ",11" notitle
