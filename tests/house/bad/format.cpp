// Compiles, means something, and is laid out as no file of this project may be.
namespace isojam
{
    int   twice( int x ){ return 2*x ; }
}
