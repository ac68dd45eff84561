#include "reference/trace.h"
#include "raster/render.h"
#include "raster/technique.h"
#include "scenes/catalog.h"
#include "scenes/plan.h"
#include "raster/stencil.h"
#include "raster/volume.h"
#include <cstdio>
#include <cmath>
#include <cstdlib>
using namespace shadowproof;
int main(int argc,char**argv){
  SceneRequest rq; rq.width=1920; rq.height=1080;
  Scene s=load_scene("/tmp/million.glb",rq); s.camera.width=1920; s.camera.height=1080;
  Tracer tr(s); GroundTruth t=trace(tr); Gpu gpu(GlPlatform::osmesa);
  Frame f=render(*find_technique(argc>1?argv[1]:"zfail_reversed"),s,make_plan(s),gpu);
  int n=0; double worst=0; long hist[8]={};
  for(int y=0;y<1080;++y)for(int x=0;x<1920;++x){ if(t.triangle.at(x,y)==no_triangle||t.triangle.at(x,y)!=f.triangle.at(x,y)) continue;
    double td=t.depth.at(x,y), fd=s.camera.near/f.depth.at(x,y); double e=std::abs(fd-td);
    const glm::dvec3 d0=ray_direction(s.camera,x+.5,y+.5);
    int b=e<1e-6?0:e<1e-5?1:e<1e-4?2:e<1e-3?3:4; ++hist[b];
    if(e>worst){worst=e; std::printf("(%d,%d) truth %.9g raster %.9g tri %u\n",x,y,td,fd,t.triangle.at(x,y));}
    (void)d0;(void)n; }
  std::printf("hist <1e-6 %ld <1e-5 %ld <1e-4 %ld <1e-3 %ld more %ld\n",hist[0],hist[1],hist[2],hist[3],hist[4]);
  for(auto n: {"zfail_reversed","zpass","zfail_infinite"}){ Frame g=render(*find_technique(n),s,make_plan(s),gpu);
  for(auto [x,y]: {std::pair{978,128},{929,152},{977,127}}){ double z=g.depth.at(x,y), nn=s.camera.near, ff=finite_far(s); double t= g.depth_model.reversed()? nn/z : g.depth_model.finite()? ff*nn/(ff-z*(ff-nn)) : nn/(1-z); std::printf("%s %d,%d nearest volume face %.9g\n",n,x,y,t);}}
}
