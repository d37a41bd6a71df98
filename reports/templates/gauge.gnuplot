# Components of a gauge study: $shares, for each of `count` bases rows (place from the top, share / %).
set terminal svg size 560,360 font "sans-serif,15" background "#ffffff"
array name[6] = ["gauge R\\&R", "repeatability", "reproducibility", "appraisers", \
  "interaction", "panels"]
set xlabel "share / %"
set xrange [0:x_high]
set yrange [6.6:0.4]
set ytics scale 0
set grid xtics
set key outside top center horizontal samplen 2 width 2
half = 0.36 / count
at(i) = 2 * half * (i - 0.5 - 0.5 * count)
plot NaN notitle, \
     $bounds using 1:(0.4):(0):(6.2) with vectors nohead lc rgb "#444444" lw 1.5 dt (4,4) notitle, \
     $shares index 0 using (0):1:yticlabels(name[int($1)]) with dots lc rgb "#ffffff" notitle, \
     for [i = 1:count] $shares index i - 1 \
       using (0.5 * $2):($1 + at(i)):(0):2:($1 + at(i) - half):($1 + at(i) + half) \
       with boxxyerror lw 1 dt solid fc rgb (i == 1 ? "#005a9c" : "#b34700") \
       fs pattern (i == 1 ? 3 : 5) border lc rgb "#222222" title sprintf("%d", i), \
     for [i = 1:count] $shares index i - 1 using 2:($1 + at(i)):(sprintf("%.1f", $2)) \
       with labels left offset 0.6,0 font ",13" notitle
