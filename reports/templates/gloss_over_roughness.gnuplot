# Gloss over roughness, from rows `m G20 G60 G85` in the file named by the variable `data`.
set terminal svg size 720,400 font "sans-serif,13" background "#ffffff"
set logscale x
set xrange [0.0005:1]
set yrange [0:105]
set format x "%g"
set xlabel "rms slope m of the microfacets"
set ylabel "gloss / GU"
set grid lc rgb "#dddddd" lt 1
set key at graph 0.97,0.95 right top samplen 2
set border lc rgb "#444444"
plot data using 1:2 with lines lw 2.5 lc rgb "#0072b2" title "20 deg", \
     data using 1:3 with lines lw 2.5 lc rgb "#d55e00" title "60 deg", \
     data using 1:4 with lines lw 2.5 lc rgb "#009e73" title "85 deg"
